// The token by which this tab says who it is: kept in the tab alone, sent as a message, never in an address.
const KEY = 'skerry.token';

export const token = () => sessionStorage.getItem(KEY) ?? '';

// input: the field that asks for it. changed: called after another was typed.
export function bindToken(input, changed) {
  input.value = token();
  input.addEventListener('change', () => {
    sessionStorage.setItem(KEY, input.value);
    changed();
  });
}
