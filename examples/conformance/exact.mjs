// What has no cautious side is decided exactly: every double is a whole multiple of 2^-1074.

const ONE = 2n ** 1074n;

// A finite double as that multiple.
function big(value) {
  let power = 1074;
  for (; !Number.isInteger(value); value *= 2) power -= 1;
  return BigInt(value) << BigInt(power);
}

// Whether abs(cos^2 + sin^2 - 1) <= bound.
export function isDirection(cos, sin, bound) {
  const [c, s] = [big(cos), big(sin)];
  const off = c * c + s * s - ONE * ONE;
  return (off < 0n ? -off : off) <= big(bound) * ONE;
}

// Whether p is in the closed triangle; one without an area holds nothing.
export function inTriangle(p, triangle) {
  for (const axis of [0, 1]) {
    const values = triangle.map((corner) => corner[axis]);
    if (p[axis] < Math.min(...values) || p[axis] > Math.max(...values)) return false;
  }
  const [q, ...corners] = [p, ...triangle].map((point) => point.map(big));
  const side = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const turn = side(...corners);
  const sides = corners.map((corner, i) => side(corner, corners[(i + 1) % 3], q));
  return turn > 0n ? sides.every((it) => it >= 0n) : turn < 0n && sides.every((it) => it <= 0n);
}
