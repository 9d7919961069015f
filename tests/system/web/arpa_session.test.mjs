// A session of an ARPA trainee on the real server, from the first press to the last, by mouse, by keys alone and by touch. What the page
// shows is held against the exercise, within the tolerances of the US assessment of radar observers (STCW): as it was when the echo was
// painted, or at the time of the list that is shown, however late a busy machine reads it.
// Antenna and plotter keep to the wall clock at any pace of the exercise (its ships would only seem faster), so three minutes of tracking
// take that long; the plotters of those who come later are at work meanwhile.
// SKERRYD and SKERRY name the two programs; HANDS one or more of mouse, keys, touch (all of them); SHOTS a folder for pictures.
// SHORT=1: without the alteration, and without the three minutes before it.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { figure, Keys, Mouse, Touch } from './arpa_hands.mjs';
import { DANGEROUS, later, NAMES, scenario, truth } from './arpa_scenario.mjs';
import { capture, launch, openConsole, waitForScan } from './browser.mjs';
import { skerry, startSkerryd } from './displays/skerryd.mjs';
import { angleBetween, blobAt } from './measure.mjs';
import { NM } from './mock_scene.mjs';
import { WEB } from './mock_server.mjs';
import { apart, canvas, extent, isRed, pixelOf, plane, readPng, rgba, targetState } from './targets_kit.mjs';

const ALL = { mouse: Mouse, keys: Keys, touch: Touch };
const CHOSEN = (process.env.HANDS ?? 'mouse,keys,touch').split(',');
const IS_SHORT = process.env.SHORT === '1';
const ACQUIRED = NAMES.slice(0, 10);
// US assessment: seconds, minutes, and what a trainee may be off by. The last three are our own; speed may be 5 kn off there.
const MAY = { readS: 30, switchS: 30, limitsS: 60, motionMin: 8, drmDeg: 5, srmKn: 5, cpaNm: 0.5, tcpaMin: 3, courseDeg: 5, speedKn: 1, placeNm: 0.1, bearingDeg: 2 };
// IEC 62388: of the range scale, and of a bearing line.
const RANGE_NM = 12, RANGE_PART = 0.01, EBL_DEG = 0.5, SHIP_NM = 160 / NM;
const LIMITS = { cpaNm: 0.8, tcpaMin: 15 };
// A key moves the cursor by whole pixels: it stands so far from the place that is meant, and is read to a tenth.
const CURSOR_DEG = 0.4;
// Three minutes of tracking, and room for a busy machine.
const TRACKED_MS = 300000;

let folder, browser, server;
const lookers = [];
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-arpa-'));
  const file = join(folder, 'arpa.yaml');
  // Those who come later find the dangerous ship farther away. By touch own ship is conned as a coaster, else she goes as ordered.
  writeFileSync(file, scenario(CHOSEN.map((name, n) => ({ tcpaMin: 13 + 4.5 * n, shipClass: name === 'touch' ? 'coaster' : null }))));
  server = await startSkerryd(['--scenario', file, '--web-root', WEB]);
  // Plotters follow echoes from the beginning for all, though they show none until it is acquired by hand.
  for (const n of CHOSEN.keys()) {
    const lookAt = ['--port', String(server.tcp), '--radar', String(n)];
    lookers.push(spawn(process.env.SKERRY, ['targets', 'watch', ...lookAt, '--for', '3600'], { stdio: 'ignore' }));
    for (let tries = 0; ; ++tries) {
      const told = await skerry(['targets', 'rules', ...lookAt, '--acquire', 'none']).then(() => null, (error) => error);
      if (!told) break;
      if (tries > 40) throw told;
      await new Promise((resolve) => setTimeout(resolve, 250));
    }
  }
  browser = await launch();
});
after(async () => {
  await browser?.close();
  for (const looker of lookers) looker.kill();
  await server?.child.end();
  if (folder) rmSync(folder, { recursive: true });
});

async function until(check, what, ms = 30000) {
  for (const end = Date.now() + ms; ;) {
    const got = await check();
    if (got) return got;
    assert.ok(Date.now() < end, what);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

// One trainee at one console.
class Session {
  constructor(t, name, n) {
    Object.assign(this, { t, name, n, worst: {}, took: {}, keys: new Map(), shots: 0 });
  }

  async open() {
    this.page = await openConsole(browser, `http://127.0.0.1:${server.http}/?radar=${this.n}`, ALL[this.name].context);
    this.hands = new ALL[this.name](this.page);
    await this.page.waitForFunction(() => window.skerry.targets().list !== null && !document.documentElement.hasAttribute('data-off'), null, { timeout: 60000 });
  }

  text(id) { return this.page.locator(`#${id}`).textContent(); }
  shows(id, wanted) { return this.page.waitForFunction(([i, w]) => document.getElementById(i).textContent === w, [id, wanted], { timeout: 30000 }); }
  async truth(name) {
    const all = await truth(server, this.n);
    return name ? all.ships.find((ship) => ship.name === name) : all;
  }
  // All ships, or one, at that second of the exercise: not of the time after a change of course or speed.
  async truthAt(exerciseS, name) {
    const all = await truth(server, this.n);
    const ships = all.ships.map((ship) => later(ship, exerciseS - all.exerciseS));
    return name ? ships.find((ship) => ship.name === name) : ships;
  }

  async shot(name) {
    if (!process.env.SHOTS) return;
    mkdirSync(process.env.SHOTS, { recursive: true });
    await this.page.screenshot({ path: join(process.env.SHOTS, `${this.name}-${++this.shots}-${name}.png`) });
  }

  off(what, value) { this.worst[what] = Math.max(this.worst[what] ?? 0, value); }

  // Wall seconds of what is timed.
  async timed(what, mostS, run) {
    const from = performance.now();
    const made = await run();
    const tookS = (performance.now() - from) / 1000;
    this.took[what] = Math.max(this.took[what] ?? 0, tookS);
    assert.ok(tookS <= mostS, `${what} took ${tookS.toFixed(1)} s`);
    return made;
  }

  // The middle of a ship's echo as it is on the screen, pixels of the picture; and where she was when it was painted.
  async echo(name) {
    return until(async () => {
      const { page } = this, { bearingDeg: about } = await this.truth(name);
      const { paintedS, ...shot } = await capture(page, about);
      const ship = await this.truthAt(paintedS, name);
      const blob = blobAt(shot, ship.bearingDeg, ship.rangeNm * NM, Math.max(2, 15 / ship.rangeNm), 0.25 * NM);
      return blob && { ...pixelOf(shot, plane(blob.bearingDeg, blob.rangeM / NM)), ship };
    }, `no echo of ${name}`);
  }

  async stand() {
    const { hands } = this;
    await hands.tab('Targets');
    if ((await this.text('range-now')) !== String(RANGE_NM)) await hands.longerRange();
    await this.shows('range-now', String(RANGE_NM));
    await hands.northUp();
    await this.shows('orientation', 'N UP');
    await hands.relativeMotion();
    await this.shows('motion', 'RM');
    await hands.hideAis();
    await this.timed('vectors', MAY.switchS, async () => {
      await hands.relativeVectors(true);
      await this.shows('vector-sign', 'VECT R 6 min');
      for (let i = 0; i < 8 && (await this.text('vector-minutes')) !== '30 min'; ++i) await hands.longerVectors();
      await this.shows('vector-sign', 'VECT R 30 min');
      await hands.relativeVectors(false);
      await this.shows('vector-sign', 'VECT T 30 min');
    });
    await waitForScan(this.page);
  }

  // Range and bearing as read, against the exercise.
  check(what, ship, rangeNm, bearingDeg) {
    const offNm = Math.abs(rangeNm - ship.rangeNm), offDeg = angleBetween(bearingDeg, ship.bearingDeg);
    this.off(`${what}Nm`, offNm);
    this.off(`${what}Deg`, offDeg);
    const hull = SHIP_NM / 2;
    assert.ok(offNm <= RANGE_NM * RANGE_PART + hull, `${what}: ${ship.name} is at ${ship.rangeNm.toFixed(3)} NM, read ${rangeNm}`);
    assert.ok(offDeg <= EBL_DEG + (Math.atan(hull / ship.rangeNm) * 180) / Math.PI, `${what}: ${ship.name} bears ${ship.bearingDeg.toFixed(2)}, read ${bearingDeg}`);
  }

  async readEchoes(names) {
    for (const name of names) {
      await this.timed('cursor', MAY.readS, async () => {
        const at = await this.echo(name);
        await this.hands.cursorTo(at);
        // The readings are renewed ten times a second.
        const there = await this.page.evaluate(({ x, y }) => window.skerry.at(x, y), at);
        await until(async () => Math.abs(figure(await this.text('cursor-range')) - there.rangeM / NM) < 0.03 &&
          angleBetween(figure(await this.text('cursor-true')), there.bearingDeg) < CURSOR_DEG, 'the cursor is not read');
        this.check('cursor', at.ship, figure(await this.text('cursor-range')), figure(await this.text('cursor-true')));
      });
    }
    await this.hands.toolsOn();
    await this.page.waitForFunction(() => !document.getElementById('ebl-box').hidden && !document.getElementById('vrm-box').hidden);
    for (const name of names) {
      await this.timed('eblAndVrm', MAY.readS, async () => {
        const at = await this.echo(name);
        await this.hands.measure(at);
        const there = await this.page.evaluate(({ x, y }) => window.skerry.at(x, y), at);
        await until(async () => Math.abs(figure(await this.text('vrm-range')) - there.rangeM / NM) < 0.03 &&
          angleBetween(figure(await this.text('ebl-true')), there.bearingDeg) < CURSOR_DEG, 'the markers are not there');
        this.check('ebl', at.ship, figure(await this.text('vrm-range')), figure(await this.text('ebl-true')));
      });
    }
  }

  async acquireAll() {
    this.acquiredAt = performance.now();
    for (const name of ACQUIRED) {
      const known = (await targetState(this.page)).list.targets.map(({ number }) => number);
      // An echo must have been seen in two turns.
      const number = await until(async () => {
        await this.hands.acquire(await this.echo(name));
        const { scan } = await this.page.evaluate(() => window.skerry.state());
        await this.page.waitForFunction(([k, s]) => window.skerry.targets().list.targets.some((target) => !k.includes(target.number)) || window.skerry.state().scan > s + 1,
          [known, scan], { timeout: 30000 });
        return (await targetState(this.page)).list.targets.find((target) => !known.includes(target.number))?.number;
      }, `${name} was not acquired`, 60000);
      this.keys.set(name, `t${number}`);
    }
    const { list } = await targetState(this.page);
    assert.deepEqual(list.targets.map(({ byHand }) => byHand), ACQUIRED.map(() => true));
    assert.equal(await this.page.locator('#target-list tbody tr').count(), ACQUIRED.length);
  }

  async setLimits() {
    await this.timed('limits', MAY.limitsS, async () => {
      await this.hands.unfold('targets-rules');
      await this.hands.fill('#rule-cpaNm', String(LIMITS.cpaNm));
      await this.hands.fill('#rule-tcpaMin', String(LIMITS.tcpaMin));
      await this.page.waitForFunction(({ cpaNm, tcpaMin }) => {
        const { rules } = window.skerry.targets().list;
        return Math.abs(rules.cpaNm - cpaNm) < 1e-6 && rules.tcpaMin === tcpaMin;
      }, LIMITS);
    });
  }

  async tracked() {
    await this.page.waitForFunction((n) => window.skerry.targets().list.targets.filter(({ state }) => state === 2).length === n, ACQUIRED.length, { timeout: TRACKED_MS });
    // Of one moment, all three.
    const { state, view, scenarioS, url } = await this.page.evaluate(() => ({
      state: window.skerry.targets(), view: window.skerry.ppi, scenarioS: window.skerry.state().scenarioS, url: document.querySelector('#target-marks').toDataURL(),
    }));
    const png = readPng(url), ships = await this.truthAt(scenarioS);
    for (const name of ACQUIRED) {
      const ship = ships.find((each) => each.name === name), symbol = state.shown.find(({ key }) => key === this.keys.get(name));
      const at = pixelOf(view, plane(ship.bearingDeg, ship.rangeNm));
      assert.equal(symbol.kind, name === DANGEROUS ? 'dangerous' : 'tracked');
      assert.ok(apart(symbol, at) <= 5, `the symbol of ${name} is ${apart(symbol, at)} px off`);
      assert.ok(extent(png, at.x, at.y, 9), `nothing is drawn at ${name}`);
    }
  }

  // Red pixels in a box about a place.
  redIn(png, { x, y }, wide, high) {
    let red = 0;
    for (let j = -high; j <= high; ++j) for (let i = -wide; i <= wide; ++i) red += isRed(rgba(png, x + i, y + j)) ? 1 : 0;
    return red;
  }
  // Of the circle of 5 mm above and below its middle: her vector goes to the left, and her number stands to the right; neither flashes.
  async redOf(key) {
    const png = await canvas(this.page), { shown, pxPerMm } = await targetState(this.page);
    const { x, y } = shown.find((each) => each.key === key), radius = 2.5 * pxPerMm;
    return this.redIn(png, { x, y: y - radius }, 4, 3) + this.redIn(png, { x, y: y + radius }, 4, 3);
  }

  // The first of the list is she, her symbol is red and flashes, and the alarm names her.
  async findDanger() {
    const { page } = this, key = this.keys.get(DANGEROUS), number = key.slice(1);
    // Approaches are told from the trend on, a minute after the first echo.
    await page.waitForFunction((n) => window.skerry.targets().list.targets.filter(({ state }) => state === 1 || state === 2).length === n, ACQUIRED.length, { timeout: 120000 });
    const told = async () => (await page.locator('#target-list tbody tr td:nth-child(3)').allTextContents()).map(figure);
    await until(async () => (await told()).every(Number.isFinite), 'not all CPAs are told');
    assert.equal(await page.locator('#target-list thead th[aria-sort=ascending]').textContent(), 'CPA');
    assert.equal(await page.locator('#target-list tbody tr button').first().textContent(), number);
    assert.match(await page.locator('#target-list tbody tr').first().locator('th').textContent(), /!/);
    const cpas = await told();
    assert.deepEqual(cpas, [...cpas].sort((a, b) => a - b));
    await until(async () => (await this.redOf(key)) > 20, 'no red symbol');
    await until(async () => (await this.redOf(key)) === 0, 'it does not flash');
    const row = page.locator('#alert-list li', { hasText: '3044' });
    await until(async () => (await row.count()) === 1, 'no alarm');
    assert.match(await row.textContent(), new RegExp(`Alarm 3044\\.\\d+ CPA/TCPA.*arget ${number}\\b.*not acknowledged`));
    assert.equal(await page.locator('#alert-banner').getAttribute('data-priority'), 'alarm');
    assert.match(await this.text('alert-worst'), /^▲ Alarm: CPA\/TCPA/);
  }

  // The data of so many as the panel has room for, side by side.
  async readData() {
    for (let from = 0; from < ACQUIRED.length; from += 4) {
      const names = ACQUIRED.slice(from, from + 4);
      for (const name of names) await this.hands.select(this.keys.get(name));
      await until(async () => (await this.page.locator('#target-data thead th').count()) === names.length, 'the data do not stand side by side');
      const { rows, listS } = await this.dataRows(), ships = await this.truthAt(listS);
      names.forEach((name, i) => this.checkData(ships.find((ship) => ship.name === name), (label) => rows[label][i]));
      if (from === 0) await this.shot('data');
      for (const name of names) await this.hands.select(this.keys.get(name));
    }
    const minutes = (performance.now() - this.acquiredAt) / 60000;
    this.took.motionMin = minutes;
    assert.ok(minutes <= MAY.motionMin, `motions were known after ${minutes.toFixed(1)} min`);
  }

  // As shown; and the second of the exercise that the list is of.
  dataRows() {
    return this.page.locator('#target-data').evaluate((table) => ({
      listS: window.skerry.targets().list.scenarioNs / 1e9,
      rows: Object.fromEntries([...table.tBodies[0].rows].map((row) =>
        [row.cells[0].firstChild.textContent, [...row.cells].slice(1).map((cell) => cell.textContent)])),
    }));
  }

  checkData(ship, read) {
    assert.equal(read('State'), 'TRACKED');
    assert.match(read('Source'), /^Radar/);
    const east = (nm, deg) => nm * Math.sin((deg * Math.PI) / 180), north = (nm, deg) => nm * Math.cos((deg * Math.PI) / 180);
    const [rangeNm, bearingDeg] = [figure(read('Range')), figure(read('Bearing'))];
    const off = {
      placeNm: Math.hypot(east(rangeNm, bearingDeg) - east(ship.rangeNm, ship.bearingDeg), north(rangeNm, bearingDeg) - north(ship.rangeNm, ship.bearingDeg)),
      bearingDeg: angleBetween(bearingDeg, ship.bearingDeg), drmDeg: angleBetween(figure(read('Rel. course')), ship.drmDeg),
      srmKn: Math.abs(figure(read('Rel. speed')) - ship.srmKn), cpaNm: Math.abs(figure(read('CPA')) - ship.cpaNm),
      tcpaMin: Math.abs(figure(read('TCPA')) - ship.tcpaMin), speedKn: Math.abs(figure(read('Speed')) - ship.speedKn),
      ...(ship.speedKn > 2 ? { courseDeg: angleBetween(figure(read('Course')), ship.courseDeg) } : {}),
    };
    for (const [what, value] of Object.entries(off)) {
      this.off(what, value);
      assert.ok(value <= MAY[what], `${ship.name}: ${what} is off by ${value}`);
    }
  }

  async acknowledge() {
    const key = this.keys.get(DANGEROUS);
    await this.hands.acknowledge();
    await this.page.waitForFunction(() => /3044.*(?<!not )acknowledged/.test(document.getElementById('alert-list').textContent));
    assert.match(await this.text('alert-worst'), /^△ Alarm/);
    await this.page.waitForFunction((k) => !window.skerry.targets().shown.find((shown) => shown.key === k).calls, key);
    const end = Date.now() + 1500;
    while (Date.now() < end) assert.ok((await this.redOf(key)) > 20, 'it flashes still');
  }

  // The course, by tens of degrees to starboard, on which nobody is dangerous and she passes well off: the trial turns at once, own ship does not.
  async tryManoeuvres() {
    const { page, hands } = this, row = page.locator('#target-list tbody tr', { has: page.locator(`#list-${this.keys.get(DANGEROUS)}`) });
    const sign = async () => {
      // As bright as texts of targets, and not red: red is danger.
      const { centre, radiusPx } = await page.evaluate(() => window.skerry.ppi), png = await canvas(page);
      let bright = 0;
      for (let dy = -20; dy <= 20; ++dy) {
        for (let dx = -20; dx <= 20; ++dx) {
          const [r, g, b, a] = rgba(png, centre.x + dx, centre.y + radiusPx - 34 + dy);
          bright += a > 100 && Math.min(r, g, b) > 150 ? 1 : 0;
        }
      }
      return bright;
    };
    assert.equal(await sign(), 0);
    await hands.unfold('targets-trial');
    const heading = figure(await this.text('heading-short'));
    let clear = null;
    for (let by = 40; by <= 90 && clear === null; by += 10) {
      const course = Math.round((heading + by) % 360);
      await hands.fill('#trial-courseDeg', String(course));
      await hands.press('#trial-start');
      await page.waitForFunction((deg) => window.skerry.targets().list.trial?.order.courseDeg === deg, course);
      await until(async () => figure(await row.locator('td.trial').first().textContent()) >= 0, 'no outcome');
      const cpaNm = figure((await row.locator('td.trial').first().textContent()).replace('!', ''));
      if (cpaNm >= 1.5 && /no target is dangerous/.test(await this.text('trial-state'))) clear = { course, cpaNm };
    }
    assert.ok(clear, 'no course is clear');
    assert.ok((await sign()) > 40, 'no T');
    await this.shot('trial');
    await hands.press('#trial-end');
    await page.waitForFunction(() => !window.skerry.targets().list.trial);
    await until(async () => (await sign()) === 0, 'the T stays');
    return clear;
  }

  async order(course) {
    const { page, hands } = this;
    if (this.name === 'touch') {
      await hands.press('#con-page');
      await page.waitForFunction(() => document.body.dataset.fresh === 'true');
      await hands.fill('#heading-entry', String(course));
      await hands.press('#heading-form button');
      await page.waitForFunction((deg) => Math.abs(window.skerry.state().con?.headingOrderDeg - deg) < 0.01, course);
      await this.shot('con');
      await hands.press('#radar-page');
      await page.waitForFunction(() => window.skerry?.targets?.().list);
    } else {
      await hands.tab('Radar');
      await hands.fill('#order-course', String(course));
      await hands.press('#orders button');
      await hands.tab('Targets');
    }
  }

  async seeItOpen(course) {
    const { page } = this, key = this.keys.get(DANGEROUS);
    if (!(await targetState(page)).selected.includes(key)) await this.hands.select(key);
    const read = async (label) => figure((await this.dataRows()).rows[label][0]);
    await until(async () => (await read('CPA')) > LIMITS.cpaNm, 'the CPA does not open', 240000);
    await until(async () => angleBetween(figure(await this.text('heading-short')), course) < 8, 'she does not turn', 120000);
    await until(async () => (await page.locator('#alert-list li', { hasText: '3044' }).count()) === 0, 'the alarm stays', 180000);
    assert.equal(await this.text('alert-worst'), 'No alerts');
    await until(async () => (await targetState(page)).shown.find((shown) => shown.key === key).kind === 'tracked', 'her symbol stays dangerous');
    assert.equal(await this.redOf(key), 0);
    const ship = await this.truth(DANGEROUS), cpaNm = await read('CPA');
    assert.ok(ship.cpaNm > LIMITS.cpaNm);
    this.opened = cpaNm;
    this.off('cpaNm', Math.abs(cpaNm - ship.cpaNm));
    assert.ok(Math.abs(cpaNm - ship.cpaNm) <= MAY.cpaNm, `CPA ${cpaNm}, not ${ship.cpaNm}`);
    await this.hands.select(key);
  }

  async finish() {
    const { page, hands } = this;
    const [lost, cancelled] = [ACQUIRED[3], ACQUIRED[1]].map((name) => this.keys.get(name));
    await hands.select(cancelled);
    await hands.cancelSelected();
    await until(async () => (await page.locator(`#list-${cancelled}`).count()) === 0, 'it is not cancelled');
    // Gone, as a ship that sinks.
    await skerry(['exercise', 'target', 'remove', `${ACQUIRED[3]} ${this.n}`, '--port', String(server.tcp)]);
    const alert = page.locator('#alert-list li', { hasText: '3052' });
    await until(async () => (await alert.count()) === 1, 'no warning of the lost one', 90000);
    assert.match(await alert.textContent(), new RegExp(`Warning 3052.*\\b${lost.slice(1)}\\b`));
    assert.match(await page.locator('#target-list tbody tr', { has: page.locator(`#list-${lost}`) }).textContent(), /LOST/);
    await this.shot('lost');
    await hands.acknowledge();
    await until(async () => (await page.locator(`#list-${lost}`).count()) === 0, 'the lost one stays');
    await hands.cancelAll();
    await until(async () => (await page.locator('#target-list tbody tr').count()) === 0, 'not all are cancelled');
    await this.shot('end');
  }
}

CHOSEN.forEach((name, n) => {
  test(`a whole session by ${name}`, { timeout: 900000 }, async (t) => {
    const session = new Session(t, name, n);
    try {
      await session.open();
      await session.stand();
      await session.readEchoes([DANGEROUS, ACQUIRED[1], ACQUIRED[6]]);
      await session.shot('measured');
      await session.acquireAll();
      await session.setLimits();
      await session.shot('acquired');
      await session.findDanger();
      await session.shot('danger');
      await session.acknowledge();
      await session.shot('acknowledged');
      const clear = await session.tryManoeuvres();
      if (!IS_SHORT) {
        await session.tracked();
        await session.readData();
        await session.order(clear.course);
        await session.seeItOpen(clear.course);
        await session.shot('opened');
        t.diagnostic(`trial of ${clear.course}: CPA ${clear.cpaNm} NM; it opened to ${session.opened} NM`);
      }
      await session.finish();
      assert.deepEqual(session.page.problems, []);
    } catch (error) {
      await session.shot('failed').catch(() => {});
      throw error;
    } finally {
      const round = (values) => JSON.stringify(values, (_, v) => (typeof v === 'number' ? Number(v.toFixed(3)) : v));
      t.diagnostic(`worst: ${round(session.worst)}`);
      t.diagnostic(`wall seconds (motionMin: minutes): ${round(session.took)}`);
      await session.page?.context().close();
    }
  });
});
