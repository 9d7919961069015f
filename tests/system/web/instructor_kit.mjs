// What tests of the instructor's page share: the page on a mock server, and what it sent.
import { openConsole, state } from './browser.mjs';
import { MockExercise } from './mock_exercise.mjs';
import { MockServer } from './mock_server.mjs';

export async function openInstructor(browser, { exercise = {}, server: options = {}, page: pageOptions = {} } = {}) {
  const server = new MockServer({ rpm: 24, spokes: 512, cells: 256, exercise: new MockExercise(exercise), ...options });
  const url = await server.start();
  const page = await openConsole(browser, `${url}instructor`, pageOptions);
  await page.waitForFunction(() => window.skerry.state().exercise !== null);
  await page.waitForFunction(() => window.skerry.state().coast.radiusNm > 0);
  return { server, page, url, ...kitOf(server, page) };
}

function kitOf(server, page) {
  const sets = () => server.received.filter((m) => m.kind === 'set').map((m) => m.set);
  const orders = () =>
    sets()
      .filter((set) => set.exercise)
      .map((set) => set.exercise);
  // What has changed is on the screen.
  const settled = () =>
    page.evaluate(
      () =>
        new Promise((resolve) => {
          requestAnimationFrame(() => requestAnimationFrame(resolve));
        }),
    );
  // The order after so many, as a plain object without what is absent.
  const ordered = async (before, kind) => {
    for (let i = 0; i < 1000 && orders().length <= before; ++i) await page.waitForTimeout(20);
    const order = orders()[before];
    if (order?.kind !== kind) throw new Error(`${order?.kind ?? 'no order'} instead of ${kind}`);
    return order.constructor.toObject(order)[kind];
  };
  return {
    sets,
    orders,
    ordered,
    // The order that an action gives.
    async next(kind, action) {
      const before = orders().length;
      await action();
      const order = await ordered(before, kind);
      await settled();
      return order;
    },
    async choose(key) {
      await page.locator(`#ship-list [data-key=${key}]`).click();
      await settled();
    },
    async pixel(name) {
      const ship = (await state(page)).exercise.ships.find((each) => each.name === name);
      return page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [ship.latitudeDeg, ship.longitudeDeg]);
    },
    async middle() {
      const { x, y, width, height } = await page.locator('#chart').boundingBox();
      return { x: Math.round(x + width / 2), y: Math.round(y + height / 2) };
    },
    // Waits until the condition holds of the page's state.
    async until(condition, argument) {
      const holds = new Function('s', 'value', `return ${condition}`);
      for (let i = 0; !holds(await state(page), argument); ++i) {
        if (i > 1200) throw new Error(`never: ${condition}`);
        await page.waitForTimeout(25);
      }
      await settled();
    },
  };
}
