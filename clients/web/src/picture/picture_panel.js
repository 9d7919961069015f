// The panel's settings of the picture, joined to PictureSettings and the Stage.
import { nextPalette, showPalette } from '../controls.js';
import { later, t } from '../language/language.js';
import { $, showSlider } from '../widgets.js';
import { LAYERS } from './picture_settings.js';

const radios = (name) => document.querySelectorAll(`input[name=${name}]`);
const MODES = {
  'off-centre': later('Press where own ship shall be · Esc leaves'),
  measure: later('Press two points to measure · Esc leaves'),
  origin: later('Press where EBL and VRM shall begin · Esc leaves'),
  cursor: later('Arrows move the cursor · Esc leaves'),
};

// Binds them all. changed(): after each change. Gives { show(), setOrientation(name), isLineHeld() }.
export function bindPicture({ picture, stage, markers, notify, headingDeg, setDefaults }, changed) {
  let isHeld = false;
  const brilliance = Object.entries(LAYERS).map(([name, { label, least }]) => {
    const slider = Object.assign(document.createElement('input'), { type: 'range', min: least, max: 100, step: 5, id: `brilliance-${name}` });
    const value = document.createElement('output');
    const text = Object.assign(document.createElement('span'), { textContent: t(label) });
    const row = Object.assign(document.createElement('label'), { className: 'slider' });
    row.append(text, slider, value);
    slider.addEventListener('input', () => change({ brilliance: { ...picture.brilliance, [name]: Number(slider.value) } }));
    return { name, slider, value, row };
  });
  $('brilliance').append(...brilliance.map(({ row }) => row));

  const show = () => {
    showPalette(picture.palette);
    for (const [name, value] of [['orientation', picture.orientation], ['motion', picture.motion], ['trail-mode', picture.trailMode]]) {
      for (const input of radios(name)) input.checked = input.value === value;
    }
    $('stabilised').value = picture.stabilised;
    showSlider($('afterglow'), picture.afterglow);
    $('afterglow-value').textContent = String(picture.afterglow);
    $('trails').value = String(picture.trailS);
    $('echo').value = picture.echo;
    $('rings').checked = picture.rings;
    $('heading-line').checked = picture.headingLine;
    $('stern-marks').checked = picture.sternMarks;
    for (const { name, slider, value } of brilliance) {
      showSlider(slider, picture.brilliance[name]);
      value.textContent = String(picture.brilliance[name]);
    }
  };
  const change = (values) => { picture.change(values); changed(); show(); };

  // Course-up takes the heading of the moment in which it is chosen.
  const setOrientation = (name) => {
    const heading = headingDeg();
    if (name === 'course' && heading === null) {
      notify(t('Course up needs the heading'));
      show();
    } else {
      change({ orientation: name, ...(name === 'course' ? { courseDeg: heading } : {}) });
      if (name === 'head' && picture.motion === 'true') notify(t('Head up is in relative motion'), 'info');
    }
  };
  for (const input of radios('orientation')) input.addEventListener('change', () => setOrientation(input.value));
  for (const input of radios('motion')) {
    input.addEventListener('change', () => {
      // True motion has true trails only.
      change(input.value === 'true' ? { motion: 'true', trailMode: 'true' } : { motion: 'relative' });
      if (input.value === 'true' && picture.orientation === 'head') notify(t('True motion needs north up or course up'), 'info');
    });
  }
  for (const input of radios('trail-mode')) {
    input.addEventListener('change', () => {
      if (input.value === 'relative' && stage.standing.isTrue) {
        notify(t('True motion has true trails only'), 'info');
        show();
      } else {
        change({ trailMode: input.value });
      }
    });
  }
  $('stabilised').addEventListener('change', () => change({ stabilised: $('stabilised').value }));
  $('palette').addEventListener('click', () => change({ palette: nextPalette(picture.palette) }));
  $('afterglow').addEventListener('input', () => change({ afterglow: Number($('afterglow').value) }));
  $('trails').addEventListener('change', () => change({ trailS: Number($('trails').value) }));
  $('echo').addEventListener('change', () => change({ echo: $('echo').value }));
  for (const [id, name] of [['rings', 'rings'], ['heading-line', 'headingLine'], ['stern-marks', 'sternMarks']]) {
    $(id).addEventListener('change', () => change({ [name]: $(id).checked }));
  }

  $('off-centre').addEventListener('click', () => markers.setMode('off-centre'));
  $('measure').addEventListener('click', () => markers.setMode('measure'));
  $('look-ahead').addEventListener('click', () => stage.lookAhead());
  $('centre').addEventListener('click', () => stage.centre());
  $('motion-reset').addEventListener('click', () => {
    if (picture.orientation === 'course') setOrientation('course');
    if (stage.standing.isTrue) stage.reset();
  });
  $('defaults').addEventListener('click', () => $('defaults-ask').showModal());
  $('defaults-ask').addEventListener('close', () => {
    if ($('defaults-ask').returnValue === 'yes') { setDefaults(); changed(); show(); }
    $('defaults-ask').returnValue = '';
  });

  // While it is held: with a pointer, with the key of the button, or with its own.  The release of any key ends it.
  const hold = (on) => { isHeld = on; $('heading-hold').setAttribute('aria-pressed', String(on)); };
  $('heading-hold').addEventListener('pointerdown', (event) => { $('heading-hold').setPointerCapture(event.pointerId); hold(true); });
  for (const type of ['pointerup', 'pointercancel', 'blur']) $('heading-hold').addEventListener(type, () => hold(false));
  $('heading-hold').addEventListener('keydown', (event) => { if (event.key === ' ' || event.key === 'Enter') hold(true); });
  document.addEventListener('keyup', () => hold(false));
  addEventListener('blur', () => hold(false));
  show();
  return { show, setOrientation, hold, isLineHeld: () => isHeld };
}

// Says what a press in the picture means now.
export function showMode(mode) {
  $('picture-mode').hidden = mode === null;
  $('picture-mode').textContent = mode === null ? '' : t(MODES[mode]);
  $('off-centre').setAttribute('aria-pressed', String(mode === 'off-centre'));
  $('measure').setAttribute('aria-pressed', String(mode === 'measure'));
}
