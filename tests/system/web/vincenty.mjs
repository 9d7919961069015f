// Geodesics of WGS-84 by Vincenty (Survey Review 23, 1975): slow and right to a millimetre, to hold quick reckonings against. Degrees,
// metres.
const RAD = Math.PI / 180, A = 6378137, F = 1 / 298.257223563, B = A * (1 - F);

function series(cos2Alpha) {
  const u2 = (cos2Alpha * (A * A - B * B)) / (B * B);
  return [1 + (u2 / 16384) * (4096 + u2 * (-768 + u2 * (320 - 175 * u2))), (u2 / 1024) * (256 + u2 * (-128 + u2 * (74 - 47 * u2)))];
}
const deltaSigma = (b, sin, cos, cos2) =>
  b * sin * (cos2 + (b / 4) * (cos * (2 * cos2 * cos2 - 1) - (b / 6) * cos2 * (4 * sin * sin - 3) * (4 * cos2 * cos2 - 3)));
const lambdaShare = (cos2Alpha) => (F / 16) * cos2Alpha * (4 + F * (4 - 3 * cos2Alpha));

// The place on a bearing and range.
export function direct({ latitudeDeg, longitudeDeg }, bearingDeg, rangeM) {
  const tan1 = (1 - F) * Math.tan(latitudeDeg * RAD), cosU = 1 / Math.hypot(1, tan1), sinU = tan1 * cosU;
  const sinB = Math.sin(bearingDeg * RAD), cosB = Math.cos(bearingDeg * RAD);
  const sigma1 = Math.atan2(tan1, cosB), sinAlpha = cosU * sinB, cos2Alpha = 1 - sinAlpha * sinAlpha;
  const [a, b] = series(cos2Alpha);
  let sigma = rangeM / (B * a), sin = 0, cos = 0, cos2 = 0;
  for (let i = 0; i < 50; ++i) {
    [sin, cos, cos2] = [Math.sin(sigma), Math.cos(sigma), Math.cos(2 * sigma1 + sigma)];
    sigma = rangeM / (B * a) + deltaSigma(b, sin, cos, cos2);
  }
  const lat = Math.atan2(sinU * cos + cosU * sin * cosB, (1 - F) * Math.hypot(sinAlpha, sinU * sin - cosU * cos * cosB));
  const lambda = Math.atan2(sin * sinB, cosU * cos - sinU * sin * cosB);
  const c = lambdaShare(cos2Alpha);
  const lon = lambda - (1 - c) * F * sinAlpha * (sigma + c * sin * (cos2 + c * cos * (2 * cos2 * cos2 - 1)));
  return { latitudeDeg: lat / RAD, longitudeDeg: ((longitudeDeg + lon / RAD + 540) % 360) - 180 };
}

// { bearingDeg, rangeM } of one place from another.
export function inverse(from, to) {
  const l = (((to.longitudeDeg - from.longitudeDeg + 540) % 360) - 180) * RAD;
  const u1 = Math.atan((1 - F) * Math.tan(from.latitudeDeg * RAD)), u2 = Math.atan((1 - F) * Math.tan(to.latitudeDeg * RAD));
  const [s1, c1, s2, c2] = [Math.sin(u1), Math.cos(u1), Math.sin(u2), Math.cos(u2)];
  let lambda = l, sin = 0, cos = 0, sigma = 0, cos2Alpha = 0, cos2 = 0;
  for (let i = 0; i < 100; ++i) {
    sin = Math.hypot(c2 * Math.sin(lambda), c1 * s2 - s1 * c2 * Math.cos(lambda));
    if (sin === 0) return { bearingDeg: 0, rangeM: 0 };
    cos = s1 * s2 + c1 * c2 * Math.cos(lambda);
    sigma = Math.atan2(sin, cos);
    const sinAlpha = (c1 * c2 * Math.sin(lambda)) / sin;
    cos2Alpha = 1 - sinAlpha * sinAlpha;
    cos2 = cos2Alpha === 0 ? 0 : cos - (2 * s1 * s2) / cos2Alpha;
    const c = lambdaShare(cos2Alpha);
    lambda = l + (1 - c) * F * sinAlpha * (sigma + c * sin * (cos2 + c * cos * (2 * cos2 * cos2 - 1)));
  }
  const [a, b] = series(cos2Alpha);
  const bearing = Math.atan2(c2 * Math.sin(lambda), c1 * s2 - s1 * c2 * Math.cos(lambda)) / RAD;
  return { bearingDeg: (bearing + 360) % 360, rangeM: B * a * (sigma - deltaSigma(b, sin, cos, cos2)) };
}
