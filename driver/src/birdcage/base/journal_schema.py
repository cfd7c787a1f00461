"""The tables of `journal.sqlite`: faults, wear and passes share one file, and so one row of migrations.

Each entry leads from one version of the file to the next. An entry that was released is never changed: a file out there
has been through it. Append another one.
"""

from __future__ import annotations

FAULTS = (
    """CREATE TABLE fault (
        id INTEGER PRIMARY KEY, utc TEXT NOT NULL, kind TEXT NOT NULL, reason TEXT NOT NULL, sentence TEXT NOT NULL
    )""",
    "CREATE INDEX fault_by_utc ON fault (utc)",
)
WEAR = (
    """CREATE TABLE wear (
        dish TEXT NOT NULL, axis INTEGER NOT NULL, moves INTEGER NOT NULL, degrees REAL NOT NULL,
        reversals INTEGER NOT NULL, since TEXT NOT NULL, PRIMARY KEY (dish, axis)
    )""",
)
PASSES = (
    """CREATE TABLE pass (
        id INTEGER PRIMARY KEY, pursuit INTEGER NOT NULL, name TEXT NOT NULL, kind TEXT NOT NULL, norad_id INTEGER,
        frequency_hz REAL, aos TEXT, los TEXT, reach_start TEXT, reach_end TEXT, max_el_deg REAL,
        started TEXT NOT NULL, ended TEXT, outcome TEXT, controller TEXT NOT NULL, latency_s REAL,
        forecast_rms_deg REAL, forecast_max_deg REAL, demo INTEGER NOT NULL, site TEXT NOT NULL,
        elements_epoch TEXT, time_offset_s REAL NOT NULL, csv TEXT
    )""",
    "CREATE INDEX pass_by_started ON pass (started)",
    """CREATE TABLE pass_sample (
        pass INTEGER NOT NULL REFERENCES pass (id) ON DELETE CASCADE, utc TEXT NOT NULL,
        target_az_deg REAL NOT NULL, target_el_deg REAL NOT NULL, planned_az_deg REAL NOT NULL,
        planned_el_deg REAL NOT NULL, commanded_az_deg REAL NOT NULL, commanded_el_deg REAL NOT NULL,
        reported_az_deg REAL NOT NULL, reported_el_deg REAL NOT NULL, error_deg REAL NOT NULL, loss_db REAL,
        signal REAL, unit TEXT
    )""",
    "CREATE INDEX pass_sample_by_pass ON pass_sample (pass)",
    """CREATE TABLE pass_remark (
        pass INTEGER NOT NULL REFERENCES pass (id) ON DELETE CASCADE, utc TEXT NOT NULL, text TEXT NOT NULL
    )""",
    "CREATE INDEX pass_remark_by_pass ON pass_remark (pass)",
)

CLEAN = tuple(
    f"UPDATE {table} SET {column} = clean({column}) WHERE {column} != clean({column})"  # noqa: S608 - our own names
    for table, columns in (
        ("fault", ("kind", "reason", "sentence")),
        ("pass", ("name", "kind", "site", "outcome", "csv")),
        ("pass_remark", ("text",)),
    )
    for column in columns
)
"""Names used to be kept as they came, control characters and all."""

LEVELS = (
    "ALTER TABLE pass_sample ADD COLUMN signal_scatter REAL",
    "ALTER TABLE pass_sample ADD COLUMN signal_n INTEGER",
    "ALTER TABLE pass_sample ADD COLUMN snr_db REAL",
    """CREATE TABLE pass_file (
        pass INTEGER NOT NULL REFERENCES pass (id) ON DELETE CASCADE, utc TEXT NOT NULL, path TEXT NOT NULL,
        size_bytes INTEGER, files INTEGER, PRIMARY KEY (pass, path)
    )""",
)
"""How many readings a level is of, and what hooks have made."""

HEALTH = (
    "ALTER TABLE fault ADD COLUMN dish TEXT NOT NULL DEFAULT ''",
    "ALTER TABLE fault ADD COLUMN axis TEXT NOT NULL DEFAULT ''",
    "ALTER TABLE fault ADD COLUMN homing INTEGER NOT NULL DEFAULT 0",
    "ALTER TABLE fault ADD COLUMN az_deg REAL",
    "ALTER TABLE fault ADD COLUMN el_deg REAL",
    """CREATE TABLE incident (
        id INTEGER PRIMARY KEY, utc TEXT NOT NULL, dish TEXT NOT NULL, kind TEXT NOT NULL, moving INTEGER NOT NULL,
        adapter TEXT NOT NULL, sentence TEXT NOT NULL
    )""",
    "CREATE INDEX incident_by_utc ON incident (utc)",
    """CREATE TABLE reply_day (
        dish TEXT NOT NULL, adapter TEXT NOT NULL, day TEXT NOT NULL, asked INTEGER NOT NULL,
        unanswered INTEGER NOT NULL, late INTEGER NOT NULL, stray_bytes INTEGER NOT NULL,
        PRIMARY KEY (dish, adapter, day)
    )""",
    """CREATE TABLE wear_day (
        dish TEXT NOT NULL, axis INTEGER NOT NULL, day TEXT NOT NULL, moves INTEGER NOT NULL, degrees REAL NOT NULL,
        reversals INTEGER NOT NULL, PRIMARY KEY (dish, axis, day)
    )""",
    """CREATE TABLE told_setting (
        id INTEGER PRIMARY KEY, utc TEXT NOT NULL, dish TEXT NOT NULL, name TEXT NOT NULL, value TEXT NOT NULL
    )""",
    """CREATE TABLE finding_seen (
        dish TEXT NOT NULL, finding TEXT NOT NULL, utc TEXT NOT NULL, latest TEXT NOT NULL, grade REAL NOT NULL,
        PRIMARY KEY (dish, finding)
    )""",
)
"""What `birdcage.diagnostics` judges by: of which axis a fault is, what happened to dish and link, and sums by day."""

MOTOR_TESTS = (
    """CREATE TABLE motor_test (
        id INTEGER PRIMARY KEY, utc TEXT NOT NULL, dish TEXT NOT NULL, axis TEXT NOT NULL, way_deg REAL NOT NULL,
        speed_up REAL, speed_up_sigma REAL, speed_down REAL, speed_down_sigma REAL, speed_nominal REAL,
        acceleration_up REAL, acceleration_up_sigma REAL, acceleration_down REAL, acceleration_down_sigma REAL,
        acceleration_nominal REAL, arrival_deg REAL, readings INTEGER NOT NULL, stalled_at_deg REAL
    )""",
    "CREATE INDEX motor_test_by_dish ON motor_test (dish, axis)",
)

MIGRATIONS = (FAULTS, WEAR, PASSES, CLEAN, LEVELS, HEALTH, MOTOR_TESTS)
"""Of the whole file. Whoever opens it passes this, and does not take the others' tables for a newer program's."""
