// Draws the last picture, turned to where the view looks by now: one triangle, whose shader takes
// each point of the screen back to a direction and from there into the picture. Where the picture
// does not reach, a picture of the whole sphere lies behind it.

import { degreesPerPixel, projections, shape } from './projections.js';

// A branch for each kind of picture.
const branches = (formula) => Object.values(projections).map((projection, kind) =>
  `if (p.kind == ${kind}) {
    ${projection[formula]}
  }`).join(' else ');

const vertex = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

const fragment = `#version 300 es
precision highp float;
// from_screen: from the screen's camera to the picture's, one rotation for both, since a zoom to
// milliarcseconds leaves nothing of a difference of two in floats.
struct Picture { int kind; float scale; float most; vec2 size; mat3 from_screen; };
uniform Picture screen, shown, whole;
uniform bool has_shown, has_whole;
uniform vec2 canvas;
uniform sampler2D shown_pixels, whole_pixels;
out vec4 colour;

// The direction along the camera's axes through a place, in pixels from the middle.
bool direction(Picture p, vec2 at, out vec3 n) {
  vec2 w = at * p.scale;
  float square = dot(w, w);
  n = vec3(0.0);
  ${branches('direction')}
  return true;
}

bool place(Picture p, vec3 n, out vec2 at) {
  at = vec2(0.0);
  ${branches('place')}
  at /= p.scale;
  return all(lessThan(abs(at), 0.5 * p.size));
}

void main() {
  vec2 at = vec2(gl_FragCoord.x, canvas.y - gl_FragCoord.y) - 0.5 * canvas;
  colour = vec4(0.0, 0.0, 0.0, 1.0);
  vec3 n;
  vec2 found;
  if (!all(lessThanEqual(abs(at), 0.5 * screen.size)) || !direction(screen, at, n)) return;
  if (has_shown && place(shown, shown.from_screen * n, found))
    colour.rgb = textureLod(shown_pixels, found / shown.size + 0.5, 0.0).rgb;
  else if (has_whole && place(whole, whole.from_screen * n, found))
    colour.rgb = textureLod(whole_pixels, found / whole.size + 0.5, 0.0).rgb;
}`;

// b transposed before a, each of nine numbers row by row: from b's camera to a's.
function between(a, b) {
  const entry = (i, j) => a[3 * i] * b[3 * j] + a[3 * i + 1] * b[3 * j + 1] + a[3 * i + 2] * b[3 * j + 2];
  return a.map((_, k) => entry(Math.floor(k / 3), k % 3));
}

export class Projector {
  // restored() is called when the pictures were lost with the graphics card.
  constructor(canvas, restored) {
    this.canvas = canvas;
    this.gl = canvas.getContext('webgl2', { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error('this browser has no WebGL 2, which the view needs');
    this.start();
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => { this.start(); restored(); });
  }

  start() {
    const gl = this.gl;
    this.program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(gl.getProgramInfoLog(this.program));
    gl.useProgram(this.program);
    gl.clearColor(0, 0, 0, 1);
    this.framebuffer = gl.createFramebuffer();
    this.textures = { shown: gl.createTexture(), whole: gl.createTexture() };
    ['shown', 'whole'].forEach((name, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, this.textures[name]);
      for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
        [gl.TEXTURE_WRAP_S, name === 'whole' ? gl.REPEAT : gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
        gl.texParameteri(gl.TEXTURE_2D, key, value);
      gl.uniform1i(this.at(name + '_pixels'), unit);
    });
    this.has = { shown: false, whole: false };
    this.cameras = {};
  }

  at(name) { return this.gl.getUniformLocation(this.program, name); }

  // Takes a picture as the server described it: `shown`, or the `whole` sphere.
  take(name, bitmap, about) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + (name === 'shown' ? 0 : 1));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, gl.RGB, gl.UNSIGNED_BYTE, bitmap);
    this.describe(name, about.projection, about.width, about.height, about.fov_deg);
    this.cameras[name] = about.camera;
    if (name === 'shown') this.about = about;
    this.has[name] = true;
  }

  describe(name, projection, width, height, fov) {
    const gl = this.gl, { kind, scale, most = 0 } = shape(projection, width, height, fov);
    gl.uniform1i(this.at(name + '.kind'), kind);
    gl.uniform1f(this.at(name + '.scale'), scale);
    gl.uniform1f(this.at(name + '.most'), most);
    gl.uniform2f(this.at(name + '.size'), width, height);
  }

  // Whether the picture is such a view to a tenth of the screen's pixels, but for its size and what
  // rounding that to whole pixels has done to its shape.
  isShown(projection, width, height, fov, camera) {
    if (!this.has.shown) return false;
    const { about } = this, asked = shape(projection, width, height, fov),
      had = shape(about.projection, about.width, about.height, about.fov_deg);
    const pixel = degreesPerPixel(projection, width, height, fov) * Math.PI / 180;
    return had.kind === asked.kind && Math.abs(had.scale * about.width / (asked.scale * width) - 1) < 0.1 / width &&
      Math.abs(about.width * height - about.height * width) <= (width + height) / 2 &&
      camera.every((entry, k) => Math.abs(entry - about.camera[k]) < 0.1 * pixel);
  }

  // Draws the picture as it is, in the middle of the canvas.  Where the processor has to draw, this takes
  // a tenth of the shader's time.
  copy(width, height) {
    const gl = this.gl, { about } = this;
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.textures.shown, 0);
    const left = Math.floor((this.canvas.width - width) / 2), low = Math.floor((this.canvas.height - height) / 2);
    gl.blitFramebuffer(0, about.height, about.width, 0, left, low, left + width, low + height, gl.COLOR_BUFFER_BIT, gl.LINEAR);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
  }

  draw(projection, width, height, fov, camera) {
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    if (this.isShown(projection, width, height, fov, camera)) return this.copy(width, height);
    gl.uniform2f(this.at('canvas'), this.canvas.width, this.canvas.height);
    gl.uniform1i(this.at('has_shown'), this.has.shown);
    gl.uniform1i(this.at('has_whole'), this.has.whole);
    this.describe('screen', projection, width, height, fov);
    for (const name of ['shown', 'whole'])
      if (this.has[name])
        gl.uniformMatrix3fv(this.at(name + '.from_screen'), true, between(this.cameras[name], camera));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
