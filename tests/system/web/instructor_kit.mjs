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
  const orders = () => sets().filter((set) => set.exercise).map((set) => set.exercise);
  return {
    sets, orders,
    // The n-th order from now on, as a plain object without what is absent.
    async next(kind, action) {
      const before = orders().length;
      await action();
      return this.ordered(before, kind);
    },
    async ordered(before, kind) {
      for (let i = 0; i < 100 && orders().length <= before; ++i) await page.waitForTimeout(20);
      const order = orders()[before];
      if (order?.kind !== kind) throw new Error(`${order?.kind ?? 'no order'} instead of ${kind}`);
      return order.constructor.toObject(order)[kind];
    },
    choose: (key) => page.locator(`#ship-list [data-key=${key}]`).click(),
    async pixel(name) {
      const ship = (await state(page)).exercise.ships.find((each) => each.name === name);
      return page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [ship.latitudeDeg, ship.longitudeDeg]);
    },
    async middle() {
      const { x, y, width, height } = await page.locator('#chart').boundingBox();
      return { x: x + width / 2, y: y + height / 2 };
    },
    until: (text, argument) => page.waitForFunction(([t, value]) => new Function('s', 'value', `return ${t}`)(window.skerry.state(), value), [text, argument ?? null], { timeout: 10000 }),
  };
}
