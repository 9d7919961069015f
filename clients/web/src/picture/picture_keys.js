// Keys of the picture and of what measures in it, for the table of keys (keys/key_table.js).
import { focusTakesArrows } from '../keys/key_listener.js';
import { t } from '../language/language.js';
import { $ } from '../widgets.js';

const click = (id) => () => $(id).click();
const fine = (event, coarse) => (event.shiftKey ? coarse / 10 : coarse);
const choose = (name, value) => document.querySelector(`input[name=${name}][value=${value}]`).click();

// view(): the ViewGeometry of now.
export function pictureKeys({ picture, picturePanel, stage, markers, tools, toolsPanel, view }) {
  const look = t('Picture'), marks = t('Bearing lines, range markers, lines');
  // Arrows move the cursor in its mode, with Shift own ship in the off-centre mode, else the active EBL and VRM.
  const arrow = (x, y, otherwise) => (event) => {
    if (markers.mode === 'cursor') markers.moveCursor({ x: x * fine(event, 10), y: -y * fine(event, 10) });
    else if (markers.mode === 'off-centre' && event.shiftKey) stage.moveOwn({ x: x * 0.05, y: y * 0.05 });
    else otherwise(event);
  };
  const turn = (by) => arrow(by, 0, (event) => markers.turnEbl(by * fine(event, 1)));
  const move = (by) => arrow(0, by, (event) => markers.moveVrm(by * fine(event, 0.01)));
  // A key that gives the arrows something to move in the picture takes the focus there: a tab or a list would keep them.
  const intoPicture = () => { if (focusTakesArrows()) $('ppi').focus({ preventScroll: true }); };
  const byKeys = () => {
    markers.setMode('cursor');
    if (markers.mode === 'cursor') markers.moveCursor({ x: 0, y: 0 });
    $('ppi').focus({ preventScroll: true });
  };
  const toggle = (kind, n) => () => { if (tools.toggle(kind, n, view())) intoPicture(); };
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    const wasOn = markers.mode !== null;
    markers.setMode(null);
    if (wasOn && !document.querySelector('dialog[open]')) intoPicture();
  });
  return [
    { id: 'north-up', key: 'n', words: t('north up'), group: look, run: () => choose('orientation', 'north') },
    { id: 'course-up', key: 'c', words: t('course up; again: the heading of now'), group: look, run: () => picturePanel.setOrientation('course') },
    { id: 'head-up', key: 'h', words: t('head up'), group: look, run: () => choose('orientation', 'head') },
    { id: 'motion', key: 'Shift+t', words: t('true or relative motion'), group: look, run: () => choose('motion', picture.motion === 'true' ? 'relative' : 'true') },
    { id: 'off-centre', key: 'Shift+o', words: t('off-centre: press, or move own ship with Shift and arrows; again: done'), group: look, run: () => { click('off-centre')(); intoPicture(); } },
    { id: 'look-ahead', key: 'PageUp', words: t('look ahead'), group: look, run: () => stage.lookAhead() },
    { id: 'centre', key: 'Home', words: t('own ship in the centre'), group: look, run: () => stage.centre() },
    { id: 'motion-reset', key: 'End', words: t('reset of true motion and course up'), group: look, run: click('motion-reset') },
    { id: 'rings', key: 'r', words: t('range rings'), group: look, run: click('rings') },
    { id: 'heading-line', key: 'l', words: t('heading line'), group: look, run: click('heading-line') },
    { id: 'heading-hold', key: 'Shift+l', words: t('heading line off while held'), group: look, run: () => picturePanel.hold(true) },
    { id: 'palette', key: 'p', words: t('day, dusk or night colours'), group: look, run: click('palette') },
    { id: 'ebl', key: 'e', words: t('bearing line EBL 1'), group: marks, run: toggle('ebls', 0) },
    { id: 'ebl-2', key: 'Shift+e', words: t('bearing line EBL 2'), group: marks, run: toggle('ebls', 1) },
    { id: 'vrm', key: 'v', words: t('range marker VRM 1'), group: marks, run: toggle('vrms', 0) },
    { id: 'vrm-2', key: 'Shift+v', words: t('range marker VRM 2'), group: marks, run: toggle('vrms', 1) },
    { id: 'ebl-left', key: 'ArrowLeft', also: ['Shift+ArrowLeft'], words: t('active bearing line 1° to the left, with Shift 0.1°'), group: marks, run: turn(-1) },
    { id: 'ebl-right', key: 'ArrowRight', also: ['Shift+ArrowRight'], words: t('active bearing line 1° to the right, with Shift 0.1°'), group: marks, run: turn(1) },
    { id: 'vrm-out', key: 'ArrowUp', also: ['Shift+ArrowUp'], words: t('active range marker out by 1 % of the range, with Shift 0.1 %'), group: marks, run: move(1) },
    { id: 'vrm-in', key: 'ArrowDown', also: ['Shift+ArrowDown'], words: t('active range marker in by 1 % of the range, with Shift 0.1 %'), group: marks, run: move(-1) },
    { id: 'cursor', key: 'Shift+c', words: t('cursor by arrows, 10 pixels each, with Shift 1; again: done'), group: marks, run: byKeys },
    { id: 'parallel', key: 'Shift+i', words: t('parallel index lines'), group: marks, run: () => toolsPanel.toggleLines() },
    { id: 'measure', key: 'b', words: t('measure between two points'), group: marks, run: click('measure') },
  ];
}
