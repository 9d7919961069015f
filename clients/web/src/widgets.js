// Elements of the panel, joined to the SharedSettings that they show and change.
import { showRefusal } from './panel/refusal.js';
import { SharedSetting } from './shared_setting.js';

export const $ = (id) => document.getElementById(id);

// Only where it changes: a text that is spoken is spoken once.
export function write(id, text) {
  const element = $(id);
  if (element.textContent !== text) element.textContent = text;
}

export function showSlider(slider, value) {
  slider.value = value;
  const least = Number(slider.min), most = Number(slider.max);
  slider.style.setProperty('--part', `${((value - least) / (most - least)) * 100}%`);
}

// A slider, its number beside it, and the value they stand for.
export function bindSlider(id, send, text = (value) => String(Math.round(value))) {
  const slider = $(id), output = $(`${id}-value`);
  const setting = new SharedSetting(send, (value, pending) => {
    showSlider(slider, value);
    output.textContent = text(value);
    output.classList.toggle('pending', pending);
  }, (why) => showRefusal(slider, why));
  slider.addEventListener('input', () => setting.change(Number(slider.value)));
  return setting;
}

export function bindSwitch(id, send) {
  const box = $(id);
  const setting = new SharedSetting(send, (value) => { box.checked = value; }, (why) => showRefusal(box, why));
  box.addEventListener('change', () => setting.change(box.checked));
  return setting;
}

// A field for a number; what is being typed is not overwritten.
export function bindNumber(id, send) {
  const field = $(id);
  const setting = new SharedSetting(send, (value) => {
    if (document.activeElement !== field) field.value = String(Number(value.toFixed(2)));
  }, (why) => showRefusal(field, why));
  field.addEventListener('change', () => {
    if (field.validity.valid && field.value !== '') setting.change(field.valueAsNumber);
    else if (setting.value() !== null) field.value = String(setting.value());
  });
  return setting;
}

export function bindChoice(id, send) {
  const select = $(id);
  const setting = new SharedSetting(send, (value) => { select.value = String(value); }, (why) => showRefusal(select, why));
  select.addEventListener('change', () => setting.change(Number(select.value)));
  return setting;
}
