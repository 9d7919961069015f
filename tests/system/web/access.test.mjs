// Signing in in Chromium on the real server: the cookie, a class code from the instructor's page to the trainee's console,
// and what pages of other origins get.  SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { launch, openConsole, state } from './browser.mjs';
import { skerry, startSkerryd } from './displays/skerryd.mjs';

const SCENARIO = `name: Lesson
seed: 3
own_ships:
  - {name: Tern, position: {lat: 60.36, lon: 4.6}, course_deg: 250, speed_kn: 9,
     radars: [{name: X, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 6}]}
  - {name: Plain, position: {lat: 60.30, lon: 4.5}, course_deg: 90, speed_kn: 10,
     radars: [{name: Second, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 12}]}
`;
const PASSWORD = 'correct horse';

let folder, browser, server, url, log = '', contexts = [];
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-access-'));
  writeFileSync(join(folder, 'lesson.yaml'), SCENARIO);
  const users = join(folder, 'users.yaml');
  await new Promise((resolve, reject) => {
    const child = spawn(process.env.SKERRY, ['user', 'add', 'Anna', '--role', 'instructor', '--users', users], { stdio: ['pipe', 'ignore', 'inherit'] });
    child.on('error', reject);
    child.on('exit', (code) => (code === 0 ? resolve() : reject(new Error(`skerry user add: ${code}`))));
    child.stdin.end(`${PASSWORD}\n`);
  });
  browser = await launch();
  server = await startSkerryd(['--scenario', join(folder, 'lesson.yaml'), '--users', users, '--audit', join(folder, 'audit.jsonl')]);
  for (const stream of [server.child.stdout, server.child.stderr]) stream.on('data', (data) => { log += data; });
  url = `http://127.0.0.1:${server.http}/`;
});
afterEach(async () => {
  for (const context of contexts) await context.close();
  contexts = [];
});
after(async () => {
  await browser?.close();
  await server?.child.end();
  if (folder) rmSync(folder, { recursive: true });
});

async function open(path = '') {
  const page = await openConsole(browser, url + path);
  contexts.push(page.context());
  return page;
}
const login = (page, body) =>
  page.evaluate(async (sent) => {
    const answer = await fetch('login', { method: 'POST', body: JSON.stringify(sent) });
    return { status: answer.status, told: answer.ok ? await answer.json() : null };
  }, body);
const codeOf = async (ship, digits = 6) => (await skerry(['class', 'new', ship, '--digits', String(digits), '--port', String(server.tcp)])).match(/^[\d ]+$/m)[0].trim();

test('who signs in is known by a cookie that no script reads, in all tabs, until she signs out', async () => {
  const page = await open();
  const { status, told } = await login(page, { name: 'Anna', password: PASSWORD, cookie: true });
  assert.deepEqual([status, told.token, told.role], [200, undefined, 'instructor']);
  const [cookie] = await page.context().cookies();
  assert.deepEqual([cookie.name, cookie.httpOnly, cookie.secure, cookie.sameSite, cookie.path],
    ['__Host-skerry', true, true, 'Strict', '/']);
  assert.equal(await page.evaluate(() => document.cookie), '');
  const other = await page.context().newPage();
  await other.goto(`${url}conning`);
  await page.reload();
  await page.locator('#signed-in', { hasText: 'Anna · instructor · until' }).waitFor();
  await other.locator('#help-open').click();
  await other.locator('#signed-in', { hasText: 'Anna' }).waitFor();
  await page.getByRole('button', { name: 'Sign out' }).click();
  await page.locator('#signed-in').waitFor({ state: 'hidden' });
  assert.deepEqual(await page.context().cookies(), []);
});

test('the instructor makes a code and shows it large; a trainee signs in by it and is aboard her ship', async () => {
  const page = await open('instructor');
  await page.locator('#to-exercise').click();
  await page.locator('#class-ship').selectOption('Plain');
  await page.locator('#class-form button').click();
  const item = page.locator('#class-list li');
  await item.getByText('nobody has signed in yet').waitFor();
  const code = await item.locator('output').textContent();
  assert.match(code, /^\d{3} \d{3}$/);
  await item.getByRole('button', { name: 'Show large' }).click();
  assert.equal(await page.locator('#class-large-code').textContent(), code);
  assert.equal(await page.locator('#class-large-where').textContent(), `127.0.0.1:${server.http}`);
  assert.equal((await page.locator('#class-large-code').boundingBox()).height > 100, true);
  assert.equal(await page.locator('#class-large').evaluate((dialog) => dialog.scrollWidth <= dialog.clientWidth), true);
  await page.locator('#class-large button').click();

  const trainee = await open();
  assert.equal((await login(trainee, { name: 'Kim', code: '000000', cookie: true })).status, code === '000 000' ? 200 : 401);
  assert.equal((await login(trainee, { name: 'Kim', code, cookie: true })).told.ship, 'Plain');
  await trainee.reload();
  await trainee.locator('#signed-in', { hasText: 'Kim (class) · trainee · Plain' }).waitFor();
  await trainee.waitForFunction(() => window.skerry.state().radar === 1 && window.skerry.settings() !== null);
  await item.getByText('Kim').waitFor({ timeout: 15000 });
  assert.match(await item.textContent(), /1 of 20 wrong tries/);
  // Pressed twice; then she is out.
  await item.getByRole('button', { name: 'End the class code' }).click();
  await item.getByRole('button', { name: 'End the class code' }).click();
  await item.waitFor({ state: 'detached' });
  await trainee.locator('#signed-in').waitFor({ state: 'hidden' });
  assert.deepEqual(page.problems, []);
});

test('a spent code is told to the instructor', async () => {
  const page = await open('instructor');
  const code = await codeOf('Tern');
  const wrong = code.replace(' ', '') === '123456' ? '654321' : '123456';
  for (let i = 0; i < 20; ++i) assert.equal((await login(page, { name: 'Eve', code: wrong })).status, 401);
  await page.getByText('The class code of Tern takes nobody in any more: 20 wrong ones were tried').waitFor({ timeout: 15000 });
  await skerry(['class', 'end', 'Tern', '--port', String(server.tcp)]);
});

// Another port of the same host is the same site, so the browser sends the cookie along.
test('a page of another origin changes nothing with the cookie, and opens no WebSocket', async () => {
  const page = await open();
  await login(page, { name: 'Anna', password: PASSWORD, cookie: true });
  const evil = createServer((_, response) => response.writeHead(200, { 'Content-Type': 'text/html' }).end('<!doctype html><title>x</title>'));
  await new Promise((resolve) => evil.listen(0, '127.0.0.1', resolve));
  try {
    const attacker = await page.context().newPage();
    await attacker.goto(`http://127.0.0.1:${evil.address().port}/`);
    const tried = await attacker.evaluate(async (to) => {
      const outcome = async (name, promise) => [name, await promise.then(String, () => 'failed')];
      const socket = new Promise((resolve, reject) => {
        const made = new WebSocket(`${to.replace('http', 'ws')}ws`);
        made.onopen = () => resolve('open');
        made.onerror = reject;
      });
      const send = (method, mode) => fetch(`${to}login`, { method, mode, credentials: 'include', body: method === 'POST' ? '{}' : undefined });
      const form = document.body.appendChild(Object.assign(document.createElement('form'), { method: 'post', action: `${to}login`, enctype: 'text/plain' }));
      const frame = Object.assign(document.createElement('iframe'), { name: 'sent' });
      form.target = 'sent';
      document.body.append(frame);
      const loaded = new Promise((resolve) => { frame.onload = () => resolve('loaded'); });
      form.submit();
      return Object.fromEntries(await Promise.all([
        outcome('read', fetch(`${to}status`, { credentials: 'include' }).then((answer) => answer.text())),
        outcome('delete', send('DELETE', 'cors')), outcome('post', send('POST', 'cors')), outcome('socket', socket), outcome('form', loaded),
      ]));
    }, url);
    assert.deepEqual(tried, { read: 'failed', delete: 'failed', post: 'failed', socket: 'failed', form: 'loaded' });
    // She is still signed in, and nothing stands in a frame of the other page.
    assert.equal(await page.evaluate(async () => (await (await fetch('login')).json()).name), 'Anna');
    assert.equal((await state(page)).garbage, 0);
    await attacker.evaluate((to) => new Promise((resolve) => {
      const frame = Object.assign(document.createElement('iframe'), { src: to });
      frame.onload = resolve;
      document.body.append(frame);
    }), url);
    const framed = attacker.frames().find((frame) => frame.url().startsWith(url) || frame.url().startsWith('chrome-error'));
    assert.equal(await framed.evaluate(() => document.getElementById('ppi') === null), true);
  } finally {
    evil.closeAllConnections();
    evil.close();
  }
});

test('neither the log nor the audit has a password, a token or a code', async () => {
  const code = await codeOf('Tern', 8);  // found in no digest by chance
  const page = await open();
  const { told: { token } } = await login(page, { name: 'Anna', password: PASSWORD });
  await login(page, { name: 'Kim', code });
  await login(page, { name: PASSWORD, password: 'another guess' });
  assert.match(token, /^skerry_/);
  await page.evaluate(async (bearer) => {
    for (const headers of [{ Authorization: `Bearer ${bearer}` }, { Authorization: `Bearer ${bearer}x` }]) await fetch('status', { headers });
    await fetch('login', { method: 'DELETE', headers: { Authorization: `Bearer ${bearer}` } });
  }, token);
  assert.match(await skerry(['audit', 'verify', join(folder, 'audit.jsonl')]), /./);
  const audit = readFileSync(join(folder, 'audit.jsonl'), 'utf8');
  for (const who of ['Anna, instructor', 'Kim (class), trainee of Tern', 'a class code for Tern']) assert.ok(audit.includes(who), who);
  for (const secret of [PASSWORD, token.slice(0, 20), code, code.replace(' ', '')]) {
    assert.equal(audit.includes(secret), false);
    assert.equal(log.includes(secret), false);
  }
});
