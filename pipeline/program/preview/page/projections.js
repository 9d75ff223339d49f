// The projections of the page's list, and how their pictures are turned (projector.js). Each says
//   scale      from pixels to its plane, where fov is the opening in radians and width in pixels
//   direction  GLSL from a place w of that plane, square = dot(w, w), to n along the camera's axes
//   place      GLSL from n to a place `at` of that plane
// Either returns false where there is nothing. It may say
//   zenith     whether it is for an audience, and not as a camera looks
//   aspect     of its pictures; else it is the window's
//   widest     degrees of the widest opening; else the opening is always the same
//   usual      degrees of the opening to begin with; else the last one stays
//   most       the angle in radians, `p.most` in GLSL, at which its circle ends
//   middle     radians that a unit of the plane is in its middle; else 1

const equidistant = {
  zenith: true,
  aspect: 1,
  direction: `float theta = sqrt(square);
    n = vec3(theta > 1e-6 ? w * (sin(theta) / theta) : w, cos(theta));
    return theta <= p.most;`,
  place: `float sine = length(n.xy), theta = atan(sine, n.z);
    if (theta > p.most) return false;
    at = sine > 1e-7 ? n.xy * (theta / sine) : n.xy;`,
};

export const projections = {
  stereographic: {
    widest: 320,
    middle: 2,
    scale: (fov, width) => Math.tan(fov / 4) / (width / 2),
    direction: 'n = vec3(2.0 * w, 1.0 - square) / (1.0 + square);',
    place: 'at = n.xy / max(1.0 + n.z, 1e-6);',
  },
  rectilinear: {
    widest: 150,
    scale: (fov, width) => Math.tan(fov / 2) / (width / 2),
    direction: 'n = vec3(w, 1.0) * inversesqrt(1.0 + square);',
    place: 'if (n.z <= 0.0) return false; at = n.xy / n.z;',
  },
  fisheye: { ...equidistant, widest: 360, usual: 180, scale: (fov, width) => fov / width, most: (fov) => fov / 2 },
  domemaster: { ...equidistant, scale: (fov, width) => Math.PI / width, most: () => Math.PI / 2 },
  equirectangular: {
    zenith: true,
    aspect: 2,
    scale: (fov, width) => 2 * Math.PI / width,
    direction: `n = vec3(sin(w.x) * cos(w.y), cos(w.x) * cos(w.y), -sin(w.y));
    return abs(w.y) <= 1.5707964;`,
    // A whole sphere has no edge.
    place: `at = vec2(atan(n.x, n.y), -asin(clamp(n.z, -1.0, 1.0))) / p.scale;
    return true;`,
  },
};

const degree = Math.PI / 180;

// What the shader needs of a picture of that size.
export function shape(projection, width, height, fovDeg) {
  const fov = fovDeg * degree, { scale, most = () => 0 } = projections[projection];
  return { kind: Object.keys(projections).indexOf(projection), scale: scale(fov, width), most: most(fov) };
}

// The size of a picture within a box.
export function fitted(projection, width, height) {
  const { aspect } = projections[projection];
  if (!aspect) return [width, height];
  const wide = Math.min(width, aspect * height) & ~(aspect - 1);
  return [wide, wide / aspect];
}

// Degrees a pixel in the middle of such a picture.
export function degreesPerPixel(projection, width, height, fovDeg) {
  const { middle = 1 } = projections[projection];
  return middle * shape(projection, width, height, fovDeg).scale / degree;
}
