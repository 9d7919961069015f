// The Earth around a place, as a plane: range and true bearing from the anchor are right, as a radar has them. The same
// reckoning as the server's (echo/chart/local_plane.hpp): the chord between two points of WGS-84, bent to an arc.
//
// Error against the geodesic from the anchor, to 24 NM: 1 mm and 1e-5 deg; from a place 5 km off the anchor 1 cm and 1e-3 deg.
// Degrees and metres throughout.
const RAD = Math.PI / 180;
const A = 6378137;
const F = 1 / 298.257223563;
const E2 = F * (2 - F);

export const wrapLongitude = (deg) => ((((deg + 180) % 360) + 360) % 360) - 180;
const normalRadius = (sin) => A / Math.sqrt(1 - E2 * sin * sin);

export class LocalPlane {
  constructor({ latitudeDeg, longitudeDeg }) {
    this.anchor = { latitudeDeg, longitudeDeg };
    this.sin = Math.sin(latitudeDeg * RAD);
    this.cos = Math.cos(latitudeDeg * RAD);
    const n = normalRadius(this.sin);
    this.x0 = n * this.cos;
    this.z0 = n * (1 - E2) * this.sin;
    this.acrossCurvature = 1 / n;
    this.alongCurvature = (1 - E2 * this.sin * this.sin) / (n * (1 - E2));
  }

  // { east, north } of a place, metres.
  toPlane(latitudeDeg, longitudeDeg) {
    const lat = latitudeDeg * RAD;
    const lon = wrapLongitude(longitudeDeg - this.anchor.longitudeDeg) * RAD;
    const sin = Math.sin(lat);
    const cos = Math.cos(lat);
    const n = normalRadius(sin);
    const dx = n * cos * Math.cos(lon) - this.x0;
    const east = n * cos * Math.sin(lon);
    const dz = n * (1 - E2) * sin - this.z0;
    const north = this.cos * dz - this.sin * dx;
    const up = this.cos * dx + this.sin * dz;
    const flat2 = east * east + north * north;
    if (flat2 === 0) return { east: 0, north: up < 0 ? 2e7 : 0 };
    // Arc over chord c on a circle of the section's curvature k (Euler): c (1 + (ck)^2/24 + 3 (ck)^4/640).
    const k = (north * north * this.alongCurvature + east * east * this.acrossCurvature) / flat2;
    const chord2 = flat2 + up * up;
    const q = chord2 * k * k;
    const stretch = Math.sqrt(chord2 / flat2) * (1 + q * (1 / 24 + (q * 3) / 640));
    return { east: east * stretch, north: north * stretch };
  }

  // The place of which toPlane() gives these, to a millimetre; within 200 NM of the anchor.
  fromPlane(east, north) {
    let { latitudeDeg, longitudeDeg } = this.anchor;
    for (let i = 0; i < 6; ++i) {
      const at = this.toPlane(latitudeDeg, longitudeDeg);
      latitudeDeg += (north - at.north) * this.alongCurvature / RAD;
      latitudeDeg = Math.max(-90, Math.min(90, latitudeDeg));
      longitudeDeg += ((east - at.east) * this.acrossCurvature) / Math.max(0.01, Math.cos(latitudeDeg * RAD)) / RAD;
    }
    return { latitudeDeg, longitudeDeg: wrapLongitude(longitudeDeg) };
  }

  // Direction of true north at a place, clockwise from the plane's north.
  northDeg(latitudeDeg, longitudeDeg) {
    const step = 1e-4;
    const a = this.toPlane(Math.max(-90, latitudeDeg - step), longitudeDeg);
    const b = this.toPlane(Math.min(90, latitudeDeg + step), longitudeDeg);
    return Math.atan2(b.east - a.east, b.north - a.north) / RAD;
  }
}

// True bearing and range of `to` from `from`.
export function bearingRange(from, to) {
  const { east, north } = new LocalPlane(from).toPlane(to.latitudeDeg, to.longitudeDeg);
  return { bearingDeg: (Math.atan2(east, north) / RAD + 360) % 360, rangeM: Math.hypot(east, north) };
}

// The place on a true bearing and range.
export function placeAt(from, bearingDeg, rangeM) {
  return new LocalPlane(from).fromPlane(rangeM * Math.sin(bearingDeg * RAD), rangeM * Math.cos(bearingDeg * RAD));
}
