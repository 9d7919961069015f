// What files of console tests share: one browser for a file, and the page and the server of a test end with it.
import { after, afterEach, before } from 'node:test';
import { launch } from './browser.mjs';

// begun(browser): once, before the tests.  ended(): after each, gives what it opened, { page, server }, and forgets it.
// options: of launch().
export function eachTest(begun, ended, options = {}) {
  let browser;
  before(async () => { browser = await launch(options); begun(browser); });
  after(() => browser?.close());
  afterEach(async () => {
    const { page, server } = ended();
    await page?.context().close();
    await server?.stop();
  });
}
