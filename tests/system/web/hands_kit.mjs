// What tests of the console's panel share: a console on a small, quick mock server.
import { openConsole } from './browser.mjs';
import { MockServer } from './mock_server.mjs';

export const SMALL = { rpm: 60, spokes: 512, cells: 256 };

export async function openSmall(browser, { server: options = {}, page: pageOptions = {}, query = '' } = {}) {
  const server = new MockServer({ ...SMALL, ...options });
  const url = await server.start();
  const page = await openConsole(browser, url + query, pageOptions);
  await page.waitForFunction(() => !document.documentElement.hasAttribute('data-off'));
  return { server, url, page };
}

// The same server again, as after a restart: it knows nothing of before.
export async function restart(server, options = {}) {
  const { port } = server;
  await server.stop();
  const next = new MockServer({ ...SMALL, port, ...options });
  await next.start();
  return next;
}

export const setsOf = (server) => server.received.filter((m) => m.kind === 'set').map((m) => m.set);

// Resolves when the server has a Set that is as wanted.
export async function untilSet(server, wanted, ms = 15000) {
  for (const end = Date.now() + ms; Date.now() < end;) {
    const found = setsOf(server).find(wanted);
    if (found) return found;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  throw new Error(`no such order: ${wanted}; the orders were ${JSON.stringify(setsOf(server))}`);
}
