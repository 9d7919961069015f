// A button for what others would feel: pressed twice.
const SURE_MS = 4000;

export function sureButton(text, label, act) {
  const button = Object.assign(document.createElement('button'), { type: 'button', textContent: text });
  button.ariaLabel = label;
  let timer;
  button.addEventListener('click', () => {
    clearTimeout(timer);
    const sure = button.classList.toggle('sure');
    button.textContent = sure ? 'Sure?' : text;
    if (!sure) act();
    else
      timer = setTimeout(() => {
        button.classList.remove('sure');
        button.textContent = text;
      }, SURE_MS);
  });
  return button;
}
