// The console's own keys. MSC.192(79) 6.1.4 wants a single key for standby and run, range, gain, tune, rain, sea, EBL and
// VRM; those of other parts (EBL, VRM, colours, AIS, acquire, acknowledge) are registered by them.
import { t } from '../language/language.js';
import { $ } from '../widgets.js';
import { writtenKey } from './key_names.js';

const click = (id) => () => { if (!$(id).disabled) $(id).click(); };

// parts: of the console, as main.js has them.  orders(run): run, unless the radar takes no orders now.
export function consoleKeys({ receiver, playback, recording, screens, help, inStandby, orders }) {
  const trim = (name, by) => orders(() => receiver.step(name, by));
  const own = t('Radar'), screen = t('Screen'), tape = t('Recording and playback');
  return [
    { id: 'range-more', key: '+', also: ['='], words: t('longer range'), group: own, run: orders(() => receiver.stepRange(1)) },
    { id: 'range-less', key: '-', words: t('shorter range'), group: own, run: orders(() => receiver.stepRange(-1)) },
    { id: 'gain-more', key: 'g', words: t('more gain'), group: own, run: trim('gain', 1) },
    { id: 'gain-less', key: 'Shift+g', words: t('less gain'), group: own, run: trim('gain', -1) },
    { id: 'sea-more', key: 'w', words: t('more sea clutter suppression (waves)'), group: own, run: trim('sea', 1) },
    { id: 'sea-less', key: 'Shift+w', words: t('less sea clutter suppression'), group: own, run: trim('sea', -1) },
    { id: 'rain-more', key: 'f', words: t('more rain clutter suppression (FTC)'), group: own, run: trim('rain', 1) },
    { id: 'rain-less', key: 'Shift+f', words: t('less rain clutter suppression'), group: own, run: trim('rain', -1) },
    { id: 'tune-more', key: 'u', words: t('tune up'), group: own, run: trim('tune', 1) },
    { id: 'tune-less', key: 'Shift+u', words: t('tune down'), group: own, run: trim('tune', -1) },
    { id: 'standby', key: 's', words: t('standby, transmit'), group: own, run: orders(() => click(inStandby() ? 'transmit-on' : 'transmit-off')()) },
    { id: 'full-screen', key: 'z', words: t('picture over the whole screen'), group: screen, run: () => screens.toggleFull() },
    { id: 'help', key: '?', words: t('this list'), group: screen, run: () => help.open() },
    { id: 'mark', key: 'm', words: t('mark this moment of what is being recorded'), group: tape, run: () => recording.mark('') },
    { id: 'playback', key: 'k', words: t('playback: play, pause'), group: tape, run: () => playback.toggle() },
    { id: 'playback-back', key: ',', words: t('playback: one turn back'), group: tape, run: () => playback.step(-1) },
    { id: 'playback-on', key: '.', words: t('playback: one turn on'), group: tape, run: () => playback.step(1) },
  ];
}

// Writes each key to the title of what does the same: <button title="Longer range" data-key="range-more">.
export function showKeyHints(table) {
  for (const element of document.querySelectorAll('[data-key]')) {
    element.dataset.words ??= element.title;
    const key = table.keyOf(element.dataset.key);
    element.title = key ? `${element.dataset.words} (${writtenKey(key).join(' ')})` : element.dataset.words;
  }
}
