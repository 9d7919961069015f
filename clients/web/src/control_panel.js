// The panel's controls as elements, made from the table of controls into the parts that index.html has for them:
// <div data-panel="receiver">, or <div data-controls="gain gainAuto"> for some of them by name, wherever they are wanted.
// A control's element has its name as id.
import { widgetOf } from './controls_table.js';
import { t } from './language/language.js';

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function input({ name, min, max }, type, step) {
  const made = element('input', { id: name, type });
  for (const [attribute, value] of Object.entries({ min, max, step })) {
    if (value !== undefined) made.setAttribute(attribute, value);
  }
  return made;
}

const label = (control, className, ...children) =>
  element('label', { className, title: control.title ? t(control.title) : '' }, ...children);
const text = (control) => element('span', { textContent: t(control.label) });

const WIDGETS = {
  slider: (control) => label(control, 'slider', text(control), input(control, 'range', control.step ?? 1),
    element('output', { id: `${control.name}-value`, textContent: '\u2013' })),
  switch: (control) => label(control, 'switch', element('input', { id: control.name, type: 'checkbox' }), text(control)),
  choice: (control) => label(control, 'row', text(control), element('select', { id: control.name },
    ...control.choices.map((choice) => new Option(t(choice.label), String(choice.value))))),
  number: (control) => label(control, 'row', text(control), input(control, 'number', 'any')),
};

// In a part of class "fields" a number stands under its label, and before what the part has.
function addToFields(part, control) {
  part.insertBefore(label(control, '', t(control.label), input(control, 'number', 'any')), part.querySelector('.wide'));
}

// A switch stands beside what its row has; a choice beside a choice, or what a pair has already.
function add(part, control, sameRow) {
  const widget = widgetOf(control);
  if (part.classList.contains('fields')) { addToFields(part, control); return; }
  const last = part.lastElementChild;
  const made = WIDGETS[widget](control);
  if (widget === 'switch' && sameRow) {
    const row = element('div', { className: 'switched' });
    last.replaceWith(row);
    row.append(last, made);
  } else if (widget === 'choice' && last?.matches('.pair') && last.childElementCount < 2) {
    last.append(made);
  } else if (widget === 'choice' && last?.matches('.row') && last.querySelector('select')) {
    const pair = element('div', { className: 'pair top' });
    last.replaceWith(pair);
    pair.append(last, made);
  } else {
    part.append(made);
  }
}

function fill(part, shown) {
  shown.sort((a, b) => a.row - b.row || (a.type === 'switch') - (b.type === 'switch'));
  shown.forEach((control, i) => add(part, control, i > 0 && shown[i - 1].row === control.row));
}

// Controls of a panel that index.html has no part for are left out.
export function buildPanel({ controls, artefacts }) {
  let rest = controls.filter(widgetOf);
  for (const part of document.querySelectorAll('[data-controls]')) {
    const names = part.dataset.controls.split(' ');
    fill(part, rest.filter(({ name }) => names.includes(name)));
    rest = rest.filter(({ name }) => !names.includes(name));
  }
  for (const part of document.querySelectorAll('[data-panel]')) fill(part, rest.filter(({ panel }) => panel === part.dataset.panel));
  document.querySelector('#artefacts').append(...artefacts.map((artefact) =>
    label(artefact, '', element('input', { id: artefact.name, type: 'checkbox' }), text(artefact))));
}
