// The console's own keys. MSC.192(79) 6.1.4 wants a single key for standby and run, range, gain, tune, rain, sea, EBL and
// VRM; those of other parts (AIS, acquire, acknowledge, cursor, brilliance) are registered by them.
import { $ } from '../widgets.js';

const click = (id) => () => { if (!$(id).disabled) $(id).click(); };
const fine = (event, coarse) => (event.shiftKey ? coarse / 10 : coarse);

// parts: of the console, as main.js has them.  orders(run): run, unless the radar takes no orders now.
export function consoleKeys({ receiver, markers, playback, recording, screens, help, inStandby, orders }) {
  const trim = (name, by) => orders(() => receiver.step(name, by));
  const choose = (name, value) => document.querySelector(`input[name=${name}][value=${value}]`).click();
  const own = 'Radar', bearings = 'Bearing line and range marker', screen = 'Screen', tape = 'Recording and playback';
  return [
    { id: 'range-more', key: '+', also: ['='], words: 'longer range', group: own, run: orders(() => receiver.stepRange(1)) },
    { id: 'range-less', key: '-', words: 'shorter range', group: own, run: orders(() => receiver.stepRange(-1)) },
    { id: 'gain-more', key: 'g', words: 'more gain', group: own, run: trim('gain', 1) },
    { id: 'gain-less', key: 'Shift+g', words: 'less gain', group: own, run: trim('gain', -1) },
    { id: 'sea-more', key: 'w', words: 'more sea clutter suppression (waves)', group: own, run: trim('sea', 1) },
    { id: 'sea-less', key: 'Shift+w', words: 'less sea clutter suppression', group: own, run: trim('sea', -1) },
    { id: 'rain-more', key: 'f', words: 'more rain clutter suppression (FTC)', group: own, run: trim('rain', 1) },
    { id: 'rain-less', key: 'Shift+f', words: 'less rain clutter suppression', group: own, run: trim('rain', -1) },
    { id: 'tune-more', key: 'u', words: 'tune up', group: own, run: trim('tune', 1) },
    { id: 'tune-less', key: 'Shift+u', words: 'tune down', group: own, run: trim('tune', -1) },
    { id: 'standby', key: 's', words: 'standby, transmit', group: own, run: orders(() => click(inStandby() ? 'transmit-on' : 'transmit-off')()) },
    { id: 'north-up', key: 'n', words: 'north up', group: own, run: () => choose('orientation', 'north') },
    { id: 'head-up', key: 'h', words: 'head up', group: own, run: () => choose('orientation', 'head') },
    { id: 'ebl', key: 'e', words: 'bearing line (EBL)', group: bearings, run: () => markers.toggle('ebl') },
    { id: 'vrm', key: 'v', words: 'range marker (VRM)', group: bearings, run: () => markers.toggle('vrm') },
    { id: 'ebl-left', key: 'ArrowLeft', also: ['Shift+ArrowLeft'], words: 'bearing line 1° to the left, with Shift 0.1°', group: bearings, run: (event) => markers.turnEbl(-fine(event, 1)) },
    { id: 'ebl-right', key: 'ArrowRight', also: ['Shift+ArrowRight'], words: 'bearing line 1° to the right, with Shift 0.1°', group: bearings, run: (event) => markers.turnEbl(fine(event, 1)) },
    { id: 'vrm-out', key: 'ArrowUp', also: ['Shift+ArrowUp'], words: 'range marker out by 1 % of the range, with Shift 0.1 %', group: bearings, run: (event) => markers.moveVrm(fine(event, 0.01)) },
    { id: 'vrm-in', key: 'ArrowDown', also: ['Shift+ArrowDown'], words: 'range marker in by 1 % of the range, with Shift 0.1 %', group: bearings, run: (event) => markers.moveVrm(-fine(event, 0.01)) },
    { id: 'rings', key: 'r', words: 'range rings', group: screen, run: click('rings') },
    { id: 'heading-line', key: 'l', words: 'heading line', group: screen, run: click('heading-line') },
    { id: 'palette', key: 'p', words: 'day, dusk or night colours', group: screen, run: click('palette') },
    { id: 'full-screen', key: 'z', words: 'picture over the whole screen', group: screen, run: () => screens.toggleFull() },
    { id: 'help', key: '?', words: 'this list', group: screen, run: () => help.open() },
    { id: 'mark', key: 'm', words: 'mark this moment of what is being recorded', group: tape, run: () => recording.mark('') },
    { id: 'playback', key: 'k', words: 'playback: play, pause', group: tape, run: () => playback.toggle() },
    { id: 'playback-back', key: ',', words: 'playback: one turn back', group: tape, run: () => playback.step(-1) },
    { id: 'playback-on', key: '.', words: 'playback: one turn on', group: tape, run: () => playback.step(1) },
  ];
}

// Writes each key to the title of what does the same: <button title="Longer range" data-key="range-more">.
export function showKeyHints(table) {
  for (const element of document.querySelectorAll('[data-key]')) {
    element.dataset.words ??= element.title;
    const key = table.keyOf(element.dataset.key);
    element.title = key ? `${element.dataset.words} (${key.replace('Shift+', 'Shift ').replace(/\b[a-z]$/, (letter) => letter.toUpperCase())})` : element.dataset.words;
  }
}
