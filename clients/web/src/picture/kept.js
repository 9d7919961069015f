// What this browser keeps between two visits. What is stored may be old, or somebody else's: only values that pass are taken.

// rules: { name: [default, isValid] }. Gives an object with every name; `given` need not be an object.
export function sound(rules, given) {
  const out = {};
  for (const [name, [standard, isValid]] of Object.entries(rules)) {
    const value = Object.hasOwn(Object(given), name) ? given[name] : undefined;
    out[name] = value !== undefined && isValid(value) ? value : structuredClone(standard);
  }
  return out;
}

export function read(key) {
  try {
    return JSON.parse(localStorage.getItem(key));
  } catch {
    return null;
  }
}

export function keep(key, value) {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // A browser that keeps nothing still shows a picture.
  }
}

export const oneOf = (...values) => (value) => values.includes(value);
export const within = (least, most) => (value) => Number.isFinite(value) && value >= least && value <= most;
export const isSwitch = (value) => typeof value === 'boolean';
