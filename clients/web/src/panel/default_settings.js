// "User default settings": one action sets all of them, also of the radar and of the targets, which others may share.
import { $ } from '../widgets.js';

const RECEIVER = { rangeNm: 6, gainAuto: true, seaAuto: true };

// parts: of the console, as main.js has them; view: the ViewGeometry of now. What the instructor has locked stays.
export function setDefaults({ picture, tools, targets, subscription, radar, set }, view, takesOrders) {
  picture.setDefaults();
  tools.setDefaults(view);
  if ($('chart-on').checked) $('chart-on').click();
  if (!takesOrders) return;
  subscription.give(RECEIVER);
  if (radar.settings?.tuneAuto === false && !radar.settings.locked.includes('tune_auto')) set({ tuneAuto: true });
  targets.setDefaults();
}
