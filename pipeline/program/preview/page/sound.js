// The show's sound, which follows the clock of its pictures.

const farthest = 0.12;  // seconds that sound and pictures may be apart

export class Sound {
  // The button switches the sound on and off, and is hidden where a show has none.
  constructor(button) {
    this.button = button;
    this.element = new Audio();
    this.on = true;
    this.stamp = null;
    button.addEventListener('click', () => {
      this.on = !this.on;
      button.setAttribute('aria-pressed', this.on);
    });
  }

  // Fetches the sound of a show unless the one that is there has this stamp.
  async take(stamp) {
    if (stamp === this.stamp) return;
    this.stamp = stamp;
    this.button.hidden = !stamp;
    URL.revokeObjectURL(this.element.src);
    this.element.removeAttribute('src');
    if (!stamp) return;
    const answer = await fetch('sound').catch(() => null);
    const heard = answer?.ok ? await answer.blob() : null;
    const why = heard ? '' : await answer?.text() ?? 'the preview does not answer';
    if (stamp !== this.stamp) return;
    this.button.disabled = !heard;
    this.button.title = why.trim() || 'sound';
    if (heard) this.element.src = URL.createObjectURL(heard);
  }

  // Slow motion and fast motion are silent beyond half and twice the speed.
  follow({ time, on, speed }) {
    const { element } = this;
    if (!element.src) return;
    if (!on || !this.on || speed < 0.5 || speed > 2) return element.pause();
    element.playbackRate = speed;
    if (!element.seeking && Math.abs(element.currentTime - time) > farthest) element.currentTime = time;
    if (element.paused) element.play().catch(() => {});
  }
}
