// The controls beside the picture: what differs from the show as its author has it.

const $ = (id) => document.getElementById(id);
const nice = (word) => word.replaceAll('_', ' ');
const ticked = (group) => [...document.querySelectorAll(`#${group} input`)];
const words = (group) => ticked(group).filter((box) => box.checked).map((box) => box.value);
const asShown = (group) => ticked(group).every((box) => box.checked === box.defaultChecked);

export class Controls {
  // changed() is called when a control was.
  constructor(changed) {
    this.changed = changed;
    $('display').addEventListener('change', () => {
      const views = this.show.displays[$('display').value];
      this.choices('grade', views, this.show.view);
      changed();
    });
    for (const id of ['grade', 'amplification']) $(id).addEventListener('change', changed);
    $('ev').addEventListener('input', () => {
      $('ev-text').textContent = `${$('ev').value < 0 ? '−' : '+'}${Math.abs($('ev').value)} EV`;
      changed();
    });
  }

  // What a user has changed stays changed when the show is read anew; all else follows the show.
  take(show) {
    this.show = show;
    this.ticks('effects', ['aberration', 'doppler_colour', 'intensity', 'lensing'].map((word) =>
      [word, show.effects[word], nice(word)]));
    this.ticks('skies', [...show.skies.map((name) => [name, true, name === 'next' ? 'next universe' : `region ${name}`]), ['stars', true, 'stars']]);
    this.ticks('overlays', show.overlays.map((word) => [word, false, nice(word)]));
    this.choices('display', Object.keys(show.displays), show.display);
    this.choices('grade', show.displays[$('display').value] ?? [show.view], show.view);
    this.choices('amplification', ['none', 'stars', 'everything'], show.effects.amplification);
  }

  ticks(group, entries) {
    const changed = new Map(ticked(group).filter((box) => box.checked !== box.defaultChecked)
      .map((box) => [box.value, box.checked]));
    $(group).replaceChildren(...entries.map(([value, on, text]) => {
      const label = document.createElement('label'), box = document.createElement('input');
      Object.assign(box, { type: 'checkbox', value, defaultChecked: on, checked: changed.get(value) ?? on });
      box.addEventListener('change', this.changed);
      label.append(box, text);
      return label;
    }));
  }

  choices(id, names, usual) {
    const choice = $(id), { usual: before } = choice.dataset, changed = before !== undefined && choice.value !== before;
    const value = changed && names.includes(choice.value) ? choice.value : names.includes(usual) ? usual : names[0];
    choice.replaceChildren(...names.map((name) => new Option(name, name, name === usual, name === value)));
    choice.dataset.usual = usual;
  }

  // Adds to a request what differs from the show.
  add(query) {
    const { show } = this;
    if (+$('ev').value) query.set('ev', $('ev').value);
    if ($('display').value !== show.display || $('grade').value !== show.view) {
      query.set('display', $('display').value);
      query.set('view', $('grade').value);
    }
    if (!asShown('effects')) query.set('effects', words('effects').join(','));
    if ($('amplification').value !== show.effects.amplification) query.set('amplification', $('amplification').value);
    if (!asShown('skies')) query.set('skies', words('skies').filter((word) => word !== 'stars').join(','));
    if (!words('skies').includes('stars')) query.set('stars', '0');
  }

  overlays() { return words('overlays').join(','); }
}
