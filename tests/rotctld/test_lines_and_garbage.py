"""How lines become commands: several on one, arguments on the next, comments, ends of lines, and what is no command."""

from __future__ import annotations

import pytest

from .scripted_rotor import ScriptedRotor, talk

HERE, OK, WRONG, UNKNOWN = b"123.46\n45.68\n", b"RPRT 0\n", b"RPRT -1\n", b"RPRT -4\n"
EXTENDED = b"get_pos:;Azimuth: 123.46;Elevation: 45.68;RPRT 0\n"


@pytest.mark.parametrize(("said", "replies"), [
    (b"p\r\n", [HERE]), (b"p\r", [HERE]), (b"p", [HERE]), (b"\n\r\n \t\n", []), (b"\r\np\n\np\n", [HERE, HERE]),
    (b"P 1 2 P 3 4 p\n", [OK, OK, HERE]), (b" p p \n", [HERE, HERE]), (b"p +S\n", [HERE, b"stop:\nRPRT 0\n"]),
    (b"p;p\n", [HERE, EXTENDED]), (b";p;p\n", [EXTENDED, EXTENDED]), (b"p # p\np\n", [HERE, HERE]), (b"# p\n", []),
    (b"#p", []), ("p # Größe\n".encode(), [HERE]),
    (b"P 1\n\xff\np\n", [WRONG, UNKNOWN, HERE]), (b"P 11\n22\n", [OK]),
    (b"P 11\r\n\r\n22 p\r\n", [OK, HERE]), (b"P\n11\n22", [OK]),
    (b"P 11 # c\n# c\n22\n", [OK]), (b"+P\n11\n22\n", [b"set_pos: 11 22\nRPRT 0\n"]), (b"M\nUP\n50\n", [OK]),
    (b"M\nUP x p\np\n", [WRONG, HERE]), (b"P\n1 x p\n", [WRONG]), (b"A 10,5\n", [b"190.500000\n"]),
    (b"L 1e3 -720.5 8\n", [WRONG]), (b"L 0 -300 8\n", [WRONG]), (b"l J~\n", [WRONG]), (b"\\loc2lonlat\n", [WRONG]),
    (b"P 11\np\n", [WRONG, HERE]), (b"P 11\nP 1 2\n", [WRONG, OK]), (b"P\nnan 2\n", [WRONG, UNKNOWN]),
    (b"P 1 2 33\n", [OK, UNKNOWN]), (b"p nonsense p\n", [HERE, UNKNOWN]), (b"P x 2 p\np\n", [WRONG, HERE]),
    (b"+zzz\n", [UNKNOWN]), (b"\\nonsense\n", [UNKNOWN]), (b"\\\n", [UNKNOWN]), (b"+\n", [UNKNOWN]),
    (b"\\P 1 2\n", [UNKNOWN]), (b"\\get_pos;p\n", [UNKNOWN]), (b"++p\n", [UNKNOWN]),
    (b"pp\n", [UNKNOWN]), (b"qp\np\n", [UNKNOWN, HERE]), (b"exit\nquit\np\n", [UNKNOWN, UNKNOWN, HERE]),
])  # fmt: skip
def test_what_is_said_and_answered(said, replies):
    assert talk(said) == replies


def test_the_last_of_two_lines_counts():
    rotor = ScriptedRotor()
    talk(b"P\n11\n22\nP 5\n6\n", rotor)
    assert rotor.calls == [("set_position", 11, 22), ("set_position", 5, 6)]


GARBAGE = [
    b"GET / HTTP/1.1\r\nHost: localhost:4533\r\nUser-Agent: curl/8\r\nAccept: */*\r\nAccept-Language: en;q=0.5\r\n\r\n",
    b"SSH-2.0-OpenSSH_9.2p1\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03KSMR", b"EHLO x\r\nMAIL FROM:<K@S>\r\n",
    b"exit\n", b"help\n", b"park\n", b"move 8 50\n", b"reset 1\n", b"Stop\n", b"PARK\n", b"R2D2\n", b"K9\n", b"SK\n",
    b"K-9\n", b"\x00K\n", b"K\x00\n", b"\xffS\n", b"P 1\x00 2\n", b"P\xa010\xa020\n", b"K\x85\n", b"AZ EL ?\n",
    b"AZ180.0 EL45.0\n", b"AZ\r", b"<PST><PARK>1</PARK></PST>\n", b"{\"P\": [1, 2]}\n", b"K.\n", b"P(10,20)\n", b"L5\n",
    b"K \x01\n", b"P 10 20 \xe9\n", b"S \xc3\xa9\n", b"K\t\x7f\n",
]  # fmt: skip


@pytest.mark.parametrize("said", GARBAGE)
def test_no_letter_is_run_out_of_garbage(said):
    rotor = ScriptedRotor()
    replies = talk(said, rotor)
    assert rotor.calls == []
    assert len(replies) == len([line for line in said.replace(b"\r", b"\n").split(b"\n") if line.strip()])
    assert set(replies) <= {WRONG, UNKNOWN}


@pytest.mark.parametrize("line", [b"p" * 1025, b"p " * 600, b"P 1" + b"0" * 2000 + b" 20", b"\x00" * 1_000_000])
def test_a_line_that_is_too_long_is_refused_once_and_the_next_one_counts(line):
    rotor = ScriptedRotor()
    assert talk(line + b"\np\n", rotor) == [WRONG, HERE]
    assert rotor.calls == [("position",)]


def test_a_line_of_1024_bytes_is_read():
    assert talk(b"p" + b" " * 1022 + b"p\n") == [HERE, HERE]
    assert talk(b"P 1" + b" " * 1020 + b"2\np\n") == [OK, HERE]
    assert talk(b"P 1" + b" " * 1021 + b"2\np\n") == [WRONG, HERE]


def test_too_long_a_line_ends_a_command_that_waits_for_its_arguments():
    rotor = ScriptedRotor()
    assert talk(b"P 10\n" + b"2" * 2000 + b"\n20\n", rotor) == [WRONG, WRONG, UNKNOWN]
    assert rotor.calls == []
