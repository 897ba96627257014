// Rotations: angles in degrees with R = Rz(yaw) Ry(pitch) Rx(roll), and unit quaternions w, x, y, z.

const RADIANS = Math.PI / 180;

/** The quaternion of roll, pitch and yaw [degrees], with w >= 0. */
export function quaternion([roll, pitch, yaw]) {
  const [cr, sr] = half(roll),
    [cp, sp] = half(pitch),
    [cy, sy] = half(yaw);
  const q = [
    cr * cp * cy + sr * sp * sy,
    sr * cp * cy - cr * sp * sy,
    cr * sp * cy + sr * cp * sy,
    cr * cp * sy - sr * sp * cy,
  ];
  return q[0] < 0 ? q.map((component) => -component) : q;
}

/** Roll, pitch and yaw [degrees] of a unit quaternion. */
export function angles([w, x, y, z]) {
  const sine = Math.min(1, Math.max(-1, 2 * (w * y - z * x)));
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ].map((angle) => angle / RADIANS);
}

/** The product of two quaternions: first `b`, then `a`. */
export function product([aw, ax, ay, az], [bw, bx, by, bz]) {
  return [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];
}

/** The quaternion of a rotation vector [rad]. */
export function fromVector(vector) {
  const angle = Math.hypot(...vector);
  if (angle === 0) return [1, 0, 0, 0];
  const factor = Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), ...vector.map((component) => factor * component)];
}

/** The rotation vector [rad] from the rotation of one quaternion to that of another, in the base frame. */
export function vectorBetween(a, b) {
  const [w, ...v] = product(b, [a[0], -a[1], -a[2], -a[3]]);
  const sine = Math.hypot(...v);
  const factor = sine > 0 ? (2 * Math.atan2(sine, Math.abs(w))) / sine : 2;
  return v.map((value) => (w < 0 ? -factor : factor) * value);
}

/** A vector, turned by a unit quaternion. */
export function turned([w, x, y, z], [a, b, c]) {
  const u = 2 * (y * c - z * b),
    v = 2 * (z * a - x * c),
    s = 2 * (x * b - y * a);
  return [a + w * u + y * s - z * v, b + w * v + z * u - x * s, c + w * s + x * v - y * u];
}

/** A turn about an axis of the base frame by an angle [degrees], after the rotation of `rpy_deg`. */
export function turnedAngles(rpy_deg, axis, degrees) {
  const vector = [0, 0, 0];
  vector[axis] = degrees * RADIANS;
  return angles(product(fromVector(vector), quaternion(rpy_deg)));
}

/** A number rounded to so many decimals, and never -0. */
export function rounded(value, decimals) {
  return Number(value.toFixed(decimals)) + 0 || 0;
}

/** Position and angles of a pose, rounded to micrometres and 1e-5 degrees. */
export function placeOf(pose) {
  return {
    position: pose.slice(0, 3).map((value) => rounded(value, 6)),
    rpy_deg: angles(pose.slice(3)).map((value) => rounded(value, 5)),
  };
}

function half(degrees) {
  return [Math.cos((degrees * RADIANS) / 2), Math.sin((degrees * RADIANS) / 2)];
}
