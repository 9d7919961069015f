// The con's autopilot: steps from what was ordered last, however late the server tells it.
import assert from 'node:assert/strict';
import { test } from 'node:test';

const element = () => ({
  querySelector: () => null, addEventListener() {}, classList: { toggle() {} }, textContent: '', placeholder: '',
});
const elements = new Map();
globalThis.document = {
  querySelectorAll: () => [],
  getElementById: (id) => { if (!elements.has(id)) elements.set(id, element()); return elements.get(id); },
};
const { Autopilot } = await import('../../../../clients/web/src/conning/autopilot.js');
const HEADING = 1;

function pilot() {
  const sent = [];
  const made = new Autopilot((values) => sent.push(values.headingDeg), () => null);
  const tell = (headingOrderDeg) => made.show({ steering: HEADING, headingOrderDeg, turnRateDegMin: 0 }, { orderedSpeedKn: 0 });
  const answer = (request) => made.takeReply({ request, code: 0 });
  return { made, sent, tell, answer, shown: () => elements.get('heading-order').textContent };
}

test('steps to and fro go on from each other, whatever of them the server tells meanwhile', () => {
  const { made, sent, tell, answer, shown } = pilot();
  tell(200);
  made.step(10);
  made.step(10);
  answer(1);
  made.step(1);
  made.step(-1);   // 220 again
  answer(2);
  tell(220);       // of the second step
  assert.equal(shown(), '220.0');
  answer(3);
  tell(221);       // of the third
  made.step(-10);
  assert.deepEqual(sent, [210, 220, 221, 220, 210]);
  answer(4);
  answer(5);
  tell(220);
  assert.equal(shown(), '210.0', 'as ordered, until the server follows');
  tell(210);
  assert.equal(made.stepped, undefined);
  clearTimeout(made.stepTimer);
});

test('what the server does not follow is not shown for ever', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { made, tell, answer, shown } = pilot();
  tell(200);
  made.step(10);
  t.mock.timers.tick(5000);
  assert.equal(shown(), '210.0', 'it is not answered yet');
  answer(1);
  t.mock.timers.tick(1100);
  assert.equal(shown(), '210.0');
  t.mock.timers.tick(200);
  assert.equal(shown(), '200.0');
});
