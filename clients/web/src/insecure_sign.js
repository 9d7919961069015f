// An open padlock beside the state of the connection, on a page of a server that other hosts reach without encryption
// or without users (skerryd --insecure). Its Hello says which, in English.
const PADLOCK = 'M4.5 7V4.8a3 3 0 0 1 5.8-1.1M3 7h10v7H3z';

function padlock() {
  const make = (name, attributes) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };
  const drawing = make('svg', { viewBox: '0 0 16 16', width: 15, height: 15, 'aria-hidden': true });
  drawing.append(make('path', { d: PADLOCK, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.8 }));
  return drawing;
}

export function signInsecure(warning) {
  const link = document.getElementById('link');
  let sign = document.getElementById('insecure');
  if (!warning || !link) { sign?.remove(); return; }
  if (!sign) {
    sign = document.createElement('span');
    sign.id = 'insecure';
    const words = document.createElement('span');
    words.className = 'unseen';
    sign.append(padlock(), words);
    link.append(sign);
  }
  sign.title = warning;
  sign.querySelector('.unseen').textContent = warning;
}
