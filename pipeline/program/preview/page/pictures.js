// Asks the server for pictures: one at a time, always the one that is wanted when the last has come.

const client = Math.random().toString(36).slice(2, 12);
const calm = 200;           // milliseconds until a view counts as still
const mostMoving = 960 * 540;  // pixels of a moving picture
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export class Pictures {
  // wanted() gives {query, width, height, fit, plays}: what is to be seen now, the size of the canvas,
  // and whether it will soon be another.
  // taken(bitmap, about) gets each picture, refused(text) what the server says against one.
  constructor(kind, wanted, taken, refused) {
    Object.assign(this, { kind, wanted, taken, refused });
    this.serial = Date.now();
    this.scale = 1;      // of a moving picture's sides, by what the last ones took
    this.have = '';      // what was got last, and whether finely
    this.seen = '';      // and what was drawn last
    this.changed = 0;    // when the wish changed last
    this.last = 0;       // when the last moving picture came
    this.wish = '';
    this.run();
  }

  // Asks anew for what is there, which was lost.
  renew() { this.have = this.seen = ''; }

  // Whether the fine picture of what is wanted is drawn.
  settled() {
    return this.next() === null && this.have.endsWith(' still') && this.seen === this.have;
  }

  size({ width, height, fit }, moving) {
    const part = moving ? Math.min(1, this.scale * Math.sqrt(mostMoving / (width * height))) : 1;
    return fit(Math.max(16, Math.min(4096, Math.round(width * part))),
      Math.max(16, Math.min(4096, Math.round(height * part))));
  }

  // The next request, or nothing where the right picture is there.
  next() {
    const wanted = this.wanted();
    if (!wanted) return null;
    const wish = `${wanted.query}&${wanted.width}&${wanted.height}`, now = performance.now();
    if (wish !== this.wish) { this.wish = wish; this.changed = now; }
    const moving = wanted.plays || now - this.changed < calm;
    const goal = wish + (moving ? ' moving' : ' still');
    if (this.have === wish + ' still' || this.have === goal) return null;
    const [w, h] = this.size(wanted, moving);
    return { goal, moving, query: `${wanted.query}&w=${w}&h=${h}&detail=${moving ? 'moving' : 'still'}` };
  }

  async run() {
    for (;;) {
      const request = this.next();
      if (!request) { await pause(8); continue; }
      const asked = this.get(request);
      // What moves is waited for, so that nothing queues. A fine picture that is no longer wanted is
      // not: the server gives it up when it hears of the next request.
      await (request.moving ? asked : Promise.race([asked, this.newWish(request)]));
    }
  }

  async newWish({ goal }) {
    for (;;) {
      await pause(8);
      const next = this.next();
      if (!next || next.goal !== goal) return;
    }
  }

  async get(request) {
    const began = performance.now(), serial = ++this.serial;
    try {
      const answer = await fetch(`picture?${request.query}&kind=${this.kind}&client=${client}&n=${serial}`);
      if (answer.status === 204) return await pause(20);
      const blob = await answer.blob();
      if (serial !== this.serial) return;
      // What is wrong stays wrong; a server that has too much to do is asked again.
      if (answer.status < 500) this.have = request.goal;
      if (answer.status !== 200) {
        this.refused((await blob.text()).trim());
        if (answer.status >= 500) await pause(500);
        return;
      }
      if (request.moving) this.adapt(began);
      // It is decoded while the server makes the next one.
      this.show(blob, JSON.parse(answer.headers.get('X-Domefall')), request.goal);
      this.refused('');
    } catch {
      this.refused('the preview has ended; start it again and open its new address');
      await pause(1000);
    }
  }

  async show(blob, about, goal) {
    const turn = this.turn = (this.turn || 0) + 1;
    const bitmap = await createImageBitmap(blob);
    if (turn >= (this.drawn || 0)) {
      this.drawn = turn;
      this.seen = goal;
      this.taken(bitmap, about);
    }
    bitmap.close();
  }

  // Pictures become smaller where fewer than 25 a second come, and grow again. What they take here,
  // to be unpacked and drawn, counts as well as what the server takes.
  adapt(began) {
    const now = performance.now(), took = Math.max(now - began, began - this.last < calm ? now - this.last : 0);
    this.last = now;
    // The aim lies below 40 ms, since one slow picture outweighs several quick ones.
    if (took > 37) this.scale = Math.max(0.35, this.scale * 0.95);
    else if (took < 34) this.scale = Math.min(1, this.scale * 1.03);
  }
}
