// The expected /controls.json, made by protobufjs from the .proto files and not by the server's own code.
const RULE = '(skerry.config.rule)', CONTROL = '(skerry.config.control)', CHOICE = '(skerry.config.choice)';
const TYPES = { double: 'number', bool: 'switch' };
const optionsOf = (field, name) => (field.parsedOptions ?? []).reduce((all, each) => ({ ...all, ...each[name] }), {});
const snake = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());

function choicesOf(schema, type) {
  const values = schema.lookupEnum(type);
  const names = Object.keys(values.values);
  const start = names[0].includes('_') ? names[0].slice(0, names[0].indexOf('_') + 1) : '';
  const skip = start && names.every((name) => name.startsWith(start)) ? start.length : 0;
  return names.map((name) => {
    const options = values.valuesOptions?.[name] ?? {};
    const word = name.slice(skip).toLowerCase().replaceAll('_', ' ');
    const label = options[`${CHOICE}.short_label`] ?? options[`${CHOICE}.label`] ?? word[0].toUpperCase() + word.slice(1);
    return { value: values.values[name], label };
  });
}

function described(schema, field, set, settings) {
  const rule = optionsOf(field, RULE), control = optionsOf(field, CONTROL);
  const type = TYPES[field.type] ?? (schema.lookup(`skerry.wire.${field.type}`).values ? 'choice' : 'message');
  const own = (message) => (message.fields[field.name] ?? message.fields[control.opposite])?.id;
  const entry = {
    name: field.name, field: snake(field.name), number: field.id, type, set: own(set), settings: own(settings),
    min: rule.min, max: rule.max, oneOf: rule.one_of, default: rule.default, unit: rule.unit, step: control.step,
    choices: type === 'choice' ? choicesOf(schema, `skerry.wire.${field.type}`) : undefined,
    label: control.short_label ?? control.label,
    title: [control.help, control.note].filter(Boolean).join('; ') || undefined,
    panel: control.panel, row: control.row, lock: control.lock,
    automaticOf: control.automatic_of && camel(control.automatic_of),
  };
  return Object.fromEntries(Object.entries(entry).filter(([, value]) => value !== undefined));
}

export function controlsDocument(schema) {
  const type = (name) => schema.lookupType(`skerry.wire.${name}`);
  const all = (name, set, settings) =>
    Object.values(type(name).fields).map((field) => described(schema, field, type(set), type(settings)));
  const group = (field) => optionsOf(field, CONTROL).group;
  const faults = all('Faults', 'Set', 'Settings').map((entry) => ({ ...entry, group: group(type('Faults').fields[entry.name]) }));
  return { controls: all('Controls', 'Set', 'Settings'), artefacts: all('Artefacts', 'WorldChange', 'World'), faults };
}
