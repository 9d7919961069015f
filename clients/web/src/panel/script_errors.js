// Script errors: what went wrong in the page itself, where the operator sees it. One bar, whatever comes after it is only
// counted: a fault in the drawing would come sixty times a second. Loaded before the page's own script, and imports
// nothing, so that it also tells of a script that could not be loaded.
const COUNT_MS = 1000;
// A browser's word for "the layout is still settling", which is no fault.
const HARMLESS = /^ResizeObserver loop/;

// In the page's language once it has one: inLanguage().
let t = (text, values = {}) => text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
export function inLanguage(translate) {
  t = translate;
}

let bar = null, more = 0, counting = null;

function button(text, run) {
  const made = document.createElement('button');
  made.type = 'button';
  made.textContent = text;
  made.addEventListener('click', run);
  return made;
}

function show(what) {
  if (bar) {
    more += 1;
    // Written once a second, and not spoken again.
    counting ??= setTimeout(() => {
      counting = null;
      if (bar) bar.querySelector('.more').textContent = ` ${t('(and {n} more)', { n: more })}`;
    }, COUNT_MS);
    return;
  }
  bar = document.createElement('div');
  bar.id = 'script-error';
  bar.setAttribute('role', 'alert');
  const text = document.createElement('p'), count = document.createElement('span');
  text.textContent = t('Fault in this page: {what}. What is shown may be wrong; reload it.', { what: what.slice(0, 200) });
  count.className = 'more';
  count.setAttribute('aria-hidden', 'true');
  text.append(count);
  bar.append(text, button(t('Reload'), () => location.reload()), button(t('Close'), () => { bar.remove(); bar = null; more = 0; }));
  document.body.append(bar);
}

addEventListener('error', (event) => {
  if (event.target instanceof HTMLElement) {
    if (event.target.matches('script, link')) show(t('{file} could not be loaded', { file: event.target.src ?? event.target.href }));
  } else if (!HARMLESS.test(event.message)) {
    show(event.error?.message ?? event.message ?? t('unknown'));
  }
}, true);
addEventListener('unhandledrejection', ({ reason }) => show(String(reason?.message ?? reason)));
