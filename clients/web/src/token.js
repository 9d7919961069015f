// The token by which this tab says who it is: kept in the tab alone, sent as a message or a header, never in an
// address.
const KEY = 'skerry.token';

export const token = () => sessionStorage.getItem(KEY) ?? '';
export const setToken = (text) => sessionStorage.setItem(KEY, text);
