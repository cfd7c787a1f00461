"""Keys that arrive together, as in one write to the terminal: read one after another before the app sees the first."""

import asyncio
import unicodedata

from birdcage_tui.shell.stopping import stop_first
from textual.drivers.headless_driver import HeadlessDriver
from textual.events import Key
from textual.keys import REPLACED_KEYS, _get_unicode_name_from_key


def key_of(name):
    """The event that Textual makes of a key."""
    try:
        character = unicodedata.lookup(_get_unicode_name_from_key(REPLACED_KEYS.get(name, name)))
    except KeyError:
        character = name if len(name) == 1 else None
    return Key(name, character)


def write(app, *names):
    """Have the driver read these keys, or events of the mouse, at once; return the events."""
    driver = stop_first(HeadlessDriver)(app)
    keys = [key_of(name) if isinstance(name, str) else name for name in names]
    for key in keys:
        driver.send_message(key)
    return keys


async def settle(app):
    """Wait until the app has dealt with all that was written, or has ended."""
    for _ in range(3):  # to the loop, to the app's queue, and out of it
        await asyncio.sleep(0)
    while app.is_running and (app.message_queue_size or not app.keys.is_idle):
        await asyncio.sleep(0.001)


def typed(text):
    """The keys of a text."""
    names = {" ": "space", ",": "comma", ".": "full_stop", ":": "colon", "-": "minus"}
    return [names.get(character, character) for character in text]
