"""Drives the live preview's page in a real browser: live_page.py DOMEFALL SHOW [--shots FOLDER] [--rate SECONDS].

It opens the page, plays, scrubs, drags, zooms, clicks, toggles, saves broken and mended shows, and
looks at what is drawn. SHOW is rewritten. With --shots it saves pictures of the window at three
sizes; with --rate it only plays for that time and says how many pictures a second were drawn.
"""

import argparse
import base64
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import wave

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

PATIENCE = 40  # seconds; a loaded machine is slow


def browser(width=960, height=720):
    options = Options()
    options.binary_location = '/usr/bin/chromium'
    for word in ('--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                 '--disable-dev-shm-usage', '--hide-scrollbars', f'--window-size={width},{height}'):
        options.add_argument(word)
    options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
    window = webdriver.Chrome(service=Service('/usr/bin/chromedriver'), options=options)
    window.set_script_timeout(PATIENCE)  # a busy machine draws without a graphics processor
    return window


class Page:
    def __init__(self, window, url):
        self.window = window
        window.get(url)
        self.until('window.domefall && window.domefall.ready', 'the first picture')

    def ask(self, words):
        return self.window.execute_script(f'return {words}')

    def until(self, words, what):
        end = time.monotonic() + PATIENCE
        while not self.ask(words):
            assert time.monotonic() < end, f'{what} did not come: {self.ask("window.domefall")} {self.log()}'
            time.sleep(0.02)

    def log(self):
        return [entry['message'] for entry in self.window.get_log('browser') if entry['level'] == 'SEVERE']

    def still(self):
        """Waits until the fine picture of what is to be seen is drawn."""
        self.until('window.domefall.fine && !window.domefall.play.on', 'a fine picture')

    def pixels(self):
        """The canvas as 32 x 18 pixels, rows of (red, green, blue)."""
        values = self.ask('''(() => {
            const small = new OffscreenCanvas(32, 18), pen = small.getContext('2d');
            pen.drawImage(document.getElementById('view'), 0, 0, 32, 18);
            return [...pen.getImageData(0, 0, 32, 18).data]; })()''')
        return [tuple(values[k:k + 3]) for k in range(0, len(values), 4)]

    def off(self):
        """By how much a code of the canvas differs, in the mean, from the fine picture as it was sent."""
        return self.window.execute_async_script('''
            const done = arguments[0], view = document.getElementById('view'), { width, height } = view;
            const codes = (picture) => {
              const pen = new OffscreenCanvas(width, height).getContext('2d');
              pen.drawImage(picture, 0, 0, width, height);
              return pen.getImageData(0, 0, width, height).data; };
            const sent = performance.getEntriesByType('resource')
              .filter(({ name }) => name.includes('kind=view') && name.includes('detail=still')).at(-1);
            fetch(sent.name.replace(/client=\\w+/, 'client=test')).then((answer) => answer.blob()).then(createImageBitmap)
              .then((picture) => {
                const a = codes(picture), b = codes(view);
                done(a.reduce((sum, code, k) => sum + Math.abs(code - b[k]), 0) / a.length); });''')

    def element(self, name):
        return self.window.find_element(By.ID, name)

    def keys(self, *keys):
        ActionChains(self.window).send_keys(*keys).perform()


def differ(a, b):
    return sum(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q)) / len(a)


def changed(page, before, what):
    end = time.monotonic() + PATIENCE
    while differ(page.pixels(), before) < 0.5:
        assert time.monotonic() < end, f'nothing changed on the screen after {what}'
        time.sleep(0.05)
    page.still()
    return page.pixels()


def drive(page, show):
    text = show.read_text()
    page.still()
    first = page.pixels()
    assert sum(map(sum, first)) > 1000, 'the picture is black'
    changes = page.ask('''performance.getEntriesByType('resource').map((entry) => entry.name)
        .filter((name) => /picture\\?.*(ev|display|view|effects|amplification|skies|stars)=/.test(name))''')
    assert not changes, f'the page changes the show by itself: {changes}'
    page.until('document.getElementById("plot").height > 200', 'the plots')
    assert page.element('i-r').text.startswith('6 M'), page.element('i-r').text

    page.element('play').click()
    page.until('window.domefall.frame > 3', 'the fourth frame')
    page.keys(' ')
    page.still()
    assert 'of' in page.element('i-frame').text

    timeline = page.element('timeline')
    ActionChains(page.window).move_to_element(timeline).click().perform()
    page.until('window.domefall.frame == 12', 'the frame that was pointed at')
    page.keys(Keys.ARROW_RIGHT)
    page.until('window.domefall.frame == 13', 'the next frame')
    page.keys(Keys.HOME)
    page.until('window.domefall.frame == 0', 'the first frame')
    page.still()

    # The screen shows what was sent, pixel for pixel.
    assert page.off() == 0, page.off()
    view, before = page.element('view'), page.pixels()
    ActionChains(page.window).drag_and_drop_by_offset(view, 150, 60).perform()
    assert not page.ask('window.domefall.view.own')
    turned = changed(page, before, 'a drag')
    asked = page.ask('window.domefall.view')
    page.keys('-', '-')
    assert abs(page.ask('window.domefall.view.fov') - asked['fov'] * 1.25 ** 2) < 1e-9
    changed(page, turned, 'a zoom')
    page.keys('0')
    page.until('window.domefall.view.own && window.domefall.view.fov == 100', "the show's camera")
    page.still()
    back = page.pixels()
    assert differ(back, before) < 2, f"the show's camera is not where it was: {differ(back, before)}"

    # The hole is in the middle of this view, and sky at its corner.
    ActionChains(page.window).click(view).perform()
    page.until('window.domefall.found', 'what is seen')
    assert page.ask('window.domefall.found.sky') == 'IV'
    corner = -(view.size['width'] // 2) + 12, -(view.size['height'] // 2) + 12
    ActionChains(page.window).move_to_element_with_offset(view, *corner).click().perform()
    page.until('window.domefall.found.sky == "I"', 'the sky')
    found = page.ask('window.domefall.found')
    assert 0 <= found['ra_deg'] < 360 and abs(found['dec_deg']) <= 90 and found['redshift'] > 0
    page.keys('c')
    page.until('window.domefall.copied', 'the camera')
    assert page.ask('window.domefall.copied') == 'camera: {look_at: hole, elevation_deg: 45}'
    page.ask("window.domefall.copied = ''")
    ActionChains(page.window).drag_and_drop_by_offset(view, 60, 0).perform()
    page.keys('c')
    page.until('window.domefall.copied', 'the camera that was turned')
    assert page.ask('window.domefall.copied').startswith('camera: {euler_deg: [')
    page.keys('0')
    page.until('window.domefall.view.own', "the show's camera")
    page.still()

    stars = page.window.find_element(By.CSS_SELECTOR, '#skies input[value=I]')
    page.ask('document.querySelectorAll("details").forEach((part) => { part.open = true; })')
    before = page.pixels()
    stars.click()
    changed(page, before, 'a sky was left out')
    stars.click()
    page.still()
    assert differ(page.pixels(), before) < 2, 'the sky did not come back'

    # A mistake is told over the last good picture, another one in its place; then the show is mended.
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    page.until('window.domefall.frame == 2', 'the third frame')
    show.write_text(text.replace('timeline:', 'timelime:'))
    page.until('window.domefall.mistake', 'the mistake')
    assert f'{show.name}:' in page.element('mistake').text and 'timelime' in page.element('mistake').text
    show.write_text(text.replace('from_r: 6', 'from_r: -6'))
    page.until('(window.domefall.mistake || "").includes("-6")', 'the second mistake')
    page.still()
    before = page.pixels()
    show.write_text(text.replace('from_r: 6', 'from_r: 12'))
    page.until('!window.domefall.mistake && window.domefall.revision == 2', 'the mended show')
    assert not page.element('mistake').is_displayed()
    changed(page, before, 'the show was mended')
    assert page.ask('window.domefall.frame') == 2, 'the same instant'
    show.write_text(text)
    page.until('window.domefall.revision == 3', 'the show as it was')

    # A named star in the middle of the view is told by its name, with a ring around its image.
    show.write_text(text.replace('timeline:', 'camera: {look_at: Sirius}\ntimeline:'))
    page.until('window.domefall.revision == 4', 'the show that looks at a star')
    page.still()
    ActionChains(page.window).move_to_element(view).click().perform()
    page.until('(window.domefall.found.star || {}).name == "Sirius"', 'the star')
    assert 'Sirius' in page.element('found').text, page.element('found').text
    rings = page.ask('''[...document.getElementById('marks').children].map((ring) => {
        const at = ring.getBoundingClientRect();
        return [(at.left + at.right) / 2, (at.top + at.bottom) / 2]; })''')
    middle = page.ask('''(() => { const at = document.getElementById('view').getBoundingClientRect();
        return [(at.left + at.right) / 2, (at.top + at.bottom) / 2]; })()''')
    assert any(abs(x - middle[0]) < 4 and abs(y - middle[1]) < 4 for x, y in rings), (rings, middle)

    # The sound goes with the pictures, and can be switched off.
    with wave.open(str(show.with_name('tone.wav')), 'wb') as tone:
        tone.setparams((1, 2, 48000, 0, 'NONE', ''))
        tone.writeframes(b'\0\1' * 96000)
    assert not page.element('sound').is_displayed()
    show.write_text(text.replace('timeline:', 'audio: tone.wav\ntimeline:'))
    page.until('window.domefall.revision == 5 && Math.abs(window.domefall.sound.duration - 2) < 0.1', 'the sound')
    page.keys(Keys.HOME, ' ')
    page.until('window.domefall.sound.currentTime > 0.4', 'some sound')
    assert abs(page.ask('window.domefall.sound.currentTime - window.domefall.play.time')) < 0.5
    page.keys(' ')
    page.until('window.domefall.sound.paused', 'silence')
    page.element('sound').click()
    page.element('first').click()
    page.element('play').click()
    page.until('window.domefall.play.time > 0.2', 'a silent picture')
    assert page.ask('window.domefall.sound.paused')
    page.element('play').click()

    # What a show says is text, whatever it looks like.
    markup = """</title><img src=x onerror='document.body.id=1'><script>document.body.id=1</script>"""
    show.write_text(text.replace('A short fall', f'"{markup}"').replace(
        'timeline:', f'markers: {{"{markup}": 1}}\ntitles: [{{text: "{markup}", at_s: 1}}]\ntimeline:'))
    page.until('window.domefall.revision == 6', 'the show that looks like a page')
    assert page.element('title').text == markup, page.element('title').text
    assert page.ask('document.title').startswith(markup)
    show.write_text(text.replace('A short fall', f'[{markup}'))
    page.until('window.domefall.mistake', 'the mistake that looks like a page')
    assert not page.ask('document.body.id || document.querySelector("img")'), 'a show wrote into its page'

    page.keys('s')
    page.until('window.domefall.saved > 1000', 'the saved picture')
    page.until('window.domefall.noted', 'the notes of check')
    assert page.element('warnings').text
    assert not page.log(), page.log()


def follow_link(page, url):
    """The printed address is a link in the page of another site, as it is in a mail or a chat."""
    page.window.get(f'data:text/html,<a href="{url}">{url}</a>')
    page.window.find_element(By.TAG_NAME, 'a').click()
    page.until('window.domefall && window.domefall.ready', 'the page behind a link')
    assert page.ask('location.href') == url


def rate(page, seconds):
    page.keys('p')
    page.window.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
        'width': 960, 'height': 540 + page.window.find_element(By.TAG_NAME, 'footer').size['height'],
        'deviceScaleFactor': 1, 'mobile': False})
    page.until('document.getElementById("view").height == 540', 'the size')
    page.still()
    page.keys(' ')
    time.sleep(1)
    drawn, began = page.ask('window.domefall.drawn'), time.monotonic()
    time.sleep(seconds)
    size = 'x'.join(map(str, page.ask('window.domefall.size')))
    count, spent = page.ask('window.domefall.drawn') - drawn, time.monotonic() - began
    print(f'{count / spent:.1f} pictures a second, the last of {size}, frame {page.ask("window.domefall.frame")}')


def shots(page, folder):
    for name, width, height, ratio in (('phone', 390, 844, 2), ('laptop', 1366, 768, 1), ('projector', 1920, 1080, 1)):
        page.window.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
            'width': width, 'height': height, 'deviceScaleFactor': ratio, 'mobile': ratio == 2})
        time.sleep(1)
        page.still()
        picture = page.window.execute_cdp_cmd('Page.captureScreenshot', {'format': 'png'})
        (folder / f'{name}.png').write_bytes(base64.b64decode(picture['data']))


def serve(domefall, show, folder):
    """The server, the address that it prints, and the file that it has opened on a desktop."""
    opener, opened = folder / 'xdg-open', folder / 'opened'
    opener.write_text(f'#!/bin/sh\nprintf %s "$1" >"{opened}.new"\nmv "{opened}.new" "{opened}"\n')
    opener.chmod(0o700)
    desktop = os.environ | {'DISPLAY': os.environ.get('DISPLAY', ':9'), 'PATH': f'{folder}:{os.environ["PATH"]}'}
    server = subprocess.Popen([domefall, 'preview', show], stdout=subprocess.PIPE, text=True, env=desktop)
    url, end = server.stdout.readline().strip(), time.monotonic() + PATIENCE
    while not opened.exists():
        assert time.monotonic() < end and server.poll() is None, 'nothing was opened'
        time.sleep(0.02)
    return server, url, opened.read_text()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('domefall')
    parser.add_argument('show', type=pathlib.Path)
    parser.add_argument('--shots', type=pathlib.Path)
    parser.add_argument('--rate', type=float)
    parser.add_argument('--frame', type=int, default=0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        server, url, opened = serve(given.domefall, given.show, pathlib.Path(folder))
    try:
        try:
            window = browser()
        except WebDriverException as error:
            print(f'no browser can be started here: {error}')
            sys.exit(77)
        try:
            page = Page(window, 'file://' + opened)
            assert page.ask('location.href') == url
            if given.frame:
                page.ask(f'window.domefall.play.time = {given.frame} / 30')
                page.keys(Keys.ARROW_RIGHT)
                page.until(f'window.domefall.frame > {given.frame}', 'the frame')
            if given.rate:
                rate(page, given.rate)
            elif given.shots:
                shots(page, given.shots)
            else:
                drive(page, given.show)
                follow_link(page, url)
        finally:
            window.quit()
    finally:
        server.terminate()
        server.wait()


main()
