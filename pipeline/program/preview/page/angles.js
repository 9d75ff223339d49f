// Cameras. Each is nine numbers, row by row: its right, its bottom and its depth along the audience's
// right, front and zenith, as the server sends them.

import { projections } from './projections.js';

const degree = Math.PI / 180;

export const narrowest = 160e-3 / 3600;  // degrees: 160 milliarcseconds

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const mix = (a, p, b, q) => a.map((x, k) => p * x + q * b[k]);

// The flat camera that looks there; angles in degrees.
function flatCamera({ az, alt, roll }) {
  const [a, h, r] = [az * degree, alt * degree, roll * degree];
  const ahead = [Math.sin(a) * Math.cos(h), Math.cos(a) * Math.cos(h), Math.sin(h)];
  const level = [Math.cos(a), -Math.sin(a), 0];
  const right = mix(level, Math.cos(r), cross(ahead, level), Math.sin(r));
  return [right, cross(ahead, right), ahead];
}

// The camera for a picture. Those for an audience have the place 45 degrees above their front.
export function cameraFor(look, projection) {
  const [right, down, ahead] = flatCamera(look), half = Math.SQRT1_2;
  if (!projections[projection].zenith) return [...right, ...down, ...ahead];
  return [...right, ...mix(ahead, half, down, half), ...mix(ahead, half, down, -half)];
}

// Where such a camera looks.
export function lookOf(camera, projection) {
  let [right, down, ahead] = [camera.slice(0, 3), camera.slice(3, 6), camera.slice(6, 9)];
  if (projections[projection].zenith) ahead = mix(down, Math.SQRT1_2, ahead, Math.SQRT1_2);
  const az = Math.atan2(ahead[0], ahead[1]), alt = Math.asin(Math.max(-1, Math.min(1, ahead[2])));
  const level = [Math.cos(az), -Math.sin(az), 0];
  const roll = Math.atan2(dot(right, cross(ahead, level)), dot(right, level));
  return { az: az / degree, alt: alt / degree, roll: roll / degree };
}
