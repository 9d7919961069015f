// The ship from above with her speeds as arrows: ahead and athwart, through the water and over ground.
import { drawing, svg } from './svg.js';

const LONGEST = 66;
// The athwart parts are drawn so many times as long, to be seen at all.
const ATHWART = 5;

export class ShipPlan {
  constructor(parent) {
    this.water = svg('path', { class: 'arrow water' });
    this.ground = svg('path', { class: 'arrow over-ground' });
    this.drawing = drawing('-70 -82 140 164', 'Speeds', svg('path', { d: 'M0 -78C16 -62 24 -44 24 -26V76H-24V-26C-24 -44 -16 -62 0 -78Z', class: 'hull' }),
      svg('line', { x1: 0, x2: 0, y1: -60, y2: 60, class: 'tick minor' }), this.water, this.ground);
    parent.append(this.drawing);
  }

  // Arrows from the midst, as long as the speeds.
  show(con) {
    const full = con?.serviceSpeedKn > 0 ? con.serviceSpeedKn : 20;
    const length = (kn, scale) => Math.max(-LONGEST, Math.min(LONGEST, (kn * scale * LONGEST) / full));
    this.water.setAttribute('d', con ? arrows(-8, length(con.waterAheadKn, 1), 22, length(con.waterStarboardKn, ATHWART)) : '');
    this.ground.setAttribute('d', con ? arrows(8, length(con.groundAheadKn, 1), 46, length(con.groundStarboardKn, ATHWART)) : '');
  }
}

// One along at x, one athwart at y.
function arrows(x, ahead, y, starboard) {
  const head = (size) => Math.sign(size) * Math.min(5, Math.abs(size));
  const along = !(Math.abs(ahead) >= 2) ? '' : `M${x} 0V${-ahead}M${x - 4} ${-ahead + head(ahead)}L${x} ${-ahead}L${x + 4} ${-ahead + head(ahead)}`;
  const athwart = !(Math.abs(starboard) >= 2) ? '' : `M0 ${y}H${starboard}M${starboard - head(starboard)} ${y - 4}L${starboard} ${y}L${starboard - head(starboard)} ${y + 4}`;
  return along + athwart;
}
