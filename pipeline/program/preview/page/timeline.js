// The show's time from left to right: segments, dissolves, fades, keyframes, markers, titles,
// warnings, and the present.

const colours = ['#5b8fc7', '#c78a5b', '#6fae72', '#b06fae', '#c7b95b', '#5bb3b0', '#c76f6f', '#8f8fc7'];

export class Timeline {
  // sought(seconds) is called while the user points.
  constructor(canvas, sought) {
    this.canvas = canvas;
    const seek = (event) => {
      const box = canvas.getBoundingClientRect();
      const part = Math.max(0, Math.min(1, (event.clientX - box.left) / box.width));
      if (this.show) sought(part * this.show.duration_s);
    };
    canvas.addEventListener('pointerdown', (event) => { canvas.setPointerCapture(event.pointerId); seek(event); });
    canvas.addEventListener('pointermove', (event) => { if (event.buttons) seek(event); });
    canvas.addEventListener('pointermove', (event) => { canvas.title = this.wordsAt(event); });
  }

  wordsAt(event) {
    if (!this.show) return '';
    const box = this.canvas.getBoundingClientRect(), seconds = this.show.duration_s / box.width;
    const time = (event.clientX - box.left) * seconds;
    const near = (at) => Math.abs(at - time) < 5 * seconds;
    const words = this.show.markers.filter((m) => near(m.time_s)).map((m) => m.name);
    for (const key of this.show.keyframes) if (near(key.time_s)) words.push('keyframe: ' + key.what);
    for (const warning of this.warnings) if (warning.time_s !== null && near(warning.time_s)) words.push(warning.text);
    for (const title of this.show.titles)
      if (title.begin_s <= time && time <= title.end_s) words.push('“' + title.text + '”');
    const segment = this.show.segments.findLastIndex((s) => s.begin_s <= time);
    if (segment >= 0) words.unshift(`${segment + 1} ${this.show.segments[segment].type}`);
    return [...new Set(words)].join('\n');
  }

  take(show) {
    this.show = show;
    this.warnings = [];
    this.canvas.setAttribute('aria-valuemax', show.duration_s);
  }

  draw(time) {
    if (!this.show) return;
    const ratio = devicePixelRatio, { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const pen = this.canvas.getContext('2d'), x = (s) => s / this.show.duration_s * width;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = '11px system-ui, sans-serif';
    this.drawSegments(pen, x);
    this.drawMarks(pen, x, width);
    pen.fillStyle = '#fff';
    pen.fillRect(x(time) - 1, 0, 2, height);
    this.canvas.setAttribute('aria-valuenow', time.toFixed(2));
    this.canvas.setAttribute('aria-valuetext', time.toFixed(2) + ' seconds');
  }

  drawSegments(pen, x) {
    const top = 14, bottom = 34;
    this.show.segments.forEach((segment, k) => {
      const [begin, end] = [x(segment.begin_s), x(segment.end_s)];
      const next = this.show.segments[k + 1];
      const [grown, tapers] = [x(segment.begin_s + segment.dissolve_s), next ? x(next.begin_s) : end];
      pen.fillStyle = colours[k % colours.length];
      pen.globalAlpha = 0.75;
      pen.beginPath();
      pen.moveTo(begin, bottom); pen.lineTo(grown, top); pen.lineTo(tapers, top); pen.lineTo(end, bottom);
      pen.fill();
      pen.globalAlpha = 1;
      pen.fillStyle = '#0c0e12';
      this.triangle(pen, begin, top, x(segment.begin_s + segment.fade_in_s), bottom);
      this.triangle(pen, end, top, x(segment.end_s - segment.fade_out_s), bottom);
      pen.fillRect(begin - 0.5, top, 1, bottom - top);
      const clear = Math.max(grown, x(segment.begin_s + segment.fade_in_s));
      const room = tapers - clear - 8, words = `${k + 1} ${segment.type}`;
      const text = pen.measureText(words).width < room ? words : `${k + 1}`;
      if (pen.measureText(text).width < room) pen.fillText(text, clear + 5, bottom - 7);
    });
  }

  triangle(pen, edge, top, inner, bottom) {
    if (edge === inner) return;
    pen.beginPath();
    pen.moveTo(edge, top); pen.lineTo(inner, top); pen.lineTo(edge, bottom);
    pen.fill();
  }

  drawMarks(pen, x, width) {
    pen.fillStyle = '#8f98a8';
    for (const title of this.show.titles)
      pen.fillRect(x(title.begin_s), 47, Math.max(2, x(title.end_s) - x(title.begin_s)), 3);
    pen.fillStyle = '#d5dae3';
    for (const key of this.show.keyframes) {
      pen.save();
      pen.translate(x(key.time_s), 40);
      pen.rotate(Math.PI / 4);
      pen.fillRect(-3, -3, 6, 6);
      pen.restore();
    }
    let free = 0;
    for (const marker of this.show.markers) {
      const at = x(marker.time_s);
      pen.fillRect(at, 2, 1, 32);
      const room = pen.measureText(marker.name).width;
      if (at < free || at + room > width) continue;
      pen.fillText(marker.name, at + 3, 11);
      free = at + room + 10;
    }
    pen.fillStyle = '#e6b25c';
    for (const warning of this.warnings) {
      if (warning.time_s === null) continue;
      const at = x(warning.time_s);
      pen.beginPath();
      pen.moveTo(at, 51); pen.lineTo(at + 5, 60); pen.lineTo(at - 5, 60);
      pen.fill();
    }
  }
}
