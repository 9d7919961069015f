// Who has the con, and whether orders of this page are taken: decided from what the server says, without the screen.

// 'none' (no ship is known), 'free', 'ours' or 'theirs'.
export function holderOf(con, you) {
  if (!con) return 'none';
  if (con.con === '') return 'free';
  return con.con === you ? 'ours' : 'theirs';
}

// Why no order can be given now; empty: orders are taken.
// state: { fresh, ship, con, you, instructor, playback }.
export function hindrance({ fresh, ship, con, you, instructor, playback }) {
  if (!fresh) return 'no data from the ship';
  if (playback) return 'a recording takes no orders';
  if (ship.driven) return 'a simulator outside drives her';
  if (holderOf(con, you) === 'theirs' && !instructor) return `${con.con} has the con`;
  return '';
}

// What the instructor has locked: 'course' and 'speed', by the names of Settings.locked.
export function lockedOrders(locked) {
  const has = (name) => locked.includes(name);
  return { course: has('course_deg') || has('con'), speed: has('speed_kn') || has('con') };
}
