"""The table of commands. A new one is a row here, a function, and a row of docs/reference/rotctld.md."""

from __future__ import annotations

from birdcage.rotctld import dish_commands as dish
from birdcage.rotctld import locator_commands as locator
from birdcage.rotctld import setting_commands as setting
from birdcage.rotctld import signal_commands as signal
from birdcage.rotctld.arguments import ArgumentShape
from birdcage.rotctld.command_row import CommandRow
from birdcage.rotctld.locator_commands import computed

_NUMBER, _INTEGER, _DIRECTION = ArgumentShape.NUMBER, ArgumentShape.INTEGER, ArgumentShape.DIRECTION
_WORD, _LINE = ArgumentShape.WORD, ArgumentShape.LINE

COMMANDS = (
    CommandRow("set_pos", "P", dish.set_pos, (_NUMBER, _NUMBER), splits=True, word=True),
    CommandRow("get_pos", "p", dish.get_pos, word=True),
    CommandRow("park", "K", dish.park),
    CommandRow("stop", "S", dish.stop, word=True),
    CommandRow("reset", "", dish.reset, (_INTEGER,)),
    CommandRow("move", "M", dish.move, (_DIRECTION, _INTEGER)),
    CommandRow("set_level", "V", setting.set_level, (_WORD, _WORD)),
    CommandRow("get_level", "v", setting.get_level, (_WORD,)),
    CommandRow("set_func", "U", setting.set_none, (_WORD, _WORD)),
    CommandRow("get_func", "u", setting.get_none, (_WORD,)),
    CommandRow("set_parm", "X", setting.set_none, (_WORD, _WORD)),
    CommandRow("get_parm", "x", setting.get_none, (_WORD,)),
    CommandRow("get_info", "_", dish.get_info, word=True),
    CommandRow("get_status", "s", dish.get_status, word=True),
    CommandRow("send_cmd", "w", dish.send_cmd, (_LINE,)),
    CommandRow("set_conf", "C", setting.set_conf, (_WORD, _WORD)),
    CommandRow("get_conf", "", setting.get_conf, (_WORD,)),
    CommandRow("dump_conf", "3", setting.dump_conf),
    CommandRow("dump_state", "", dish.dump_state, word=True),
    CommandRow("dump_caps", "1", setting.dump_caps, word=True),
    CommandRow("pause", "", dish.pause, (_INTEGER,)),
    CommandRow("lonlat2loc", "L", computed(locator.lonlat2loc), (_NUMBER, _NUMBER, _INTEGER)),
    CommandRow("loc2lonlat", "l", computed(locator.loc2lonlat), (_WORD,)),
    CommandRow("dms2dec", "D", computed(locator.dms2dec), (_INTEGER, _INTEGER, _NUMBER, _INTEGER)),
    CommandRow("dec2dms", "d", computed(locator.dec2dms), (_NUMBER,)),
    CommandRow("dmmm2dec", "E", computed(locator.dmmm2dec), (_INTEGER, _NUMBER, _INTEGER)),
    CommandRow("dec2dmmm", "e", computed(locator.dec2dmmm), (_NUMBER,)),
    CommandRow("qrb", "B", computed(locator.qrb), (_NUMBER, _NUMBER, _NUMBER, _NUMBER)),
    CommandRow("a_sp2a_lp", "A", computed(locator.a_sp2a_lp), (_NUMBER,)),
    CommandRow("d_sp2d_lp", "a", computed(locator.d_sp2d_lp), (_NUMBER,)),
    CommandRow("", "q", dish.leave),
    CommandRow("", "Q", dish.leave),
    CommandRow("get_rssi", "R", signal.get_rssi, (_INTEGER,)),
    CommandRow("get_rssi", "R", signal.get_rssi, (_INTEGER,), alone=True, word=True),
    CommandRow("enable_lna", "L", signal.enable_lna, alone=True, word=True),
    CommandRow("get_caps", "D", signal.get_caps, alone=True, word=True),
)
"""Hamlib's commands, in the order of its own table; then the published ones of ours."""

BY_NAME = {row.long: row for row in COMMANDS if row.long}
BY_WORD = {row.long: row for row in COMMANDS if row.word}
BY_LETTER = {row.short: row for row in COMMANDS if row.short and not row.alone}
BY_LETTER_ALONE = {row.short: row for row in COMMANDS if row.short and row.alone}
BARE = {typed: row for typed, row in (BY_LETTER | BY_WORD | BY_LETTER_ALONE).items() if row.alone or not row.arguments}
"""What may be all of a line: most of what is asked is `p`."""
