"""`birdcage paths`."""

from __future__ import annotations

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import find_paths, flags, global_options


@click.command("paths", epilog=EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Print where files are kept. BIRDCAGE_HOME puts all of them into one folder."""
    from birdcage.cli.say import tell, tell_json

    paths = find_paths()
    places = {
        "config": paths.config_file,
        "presets": paths.presets_file,
        "cache": paths.cache,
        "logs": paths.logs,
        "transcripts": paths.transcripts,
        "state": paths.state,
        "backups": paths.backups,
        "catalogue": paths.catalogue,
        "passes": paths.passes,
        "recordings": paths.signal_recordings,
        "levels": paths.known_levels,
        "step-track": paths.found_directions,
        "places": paths.places_file,
        "alignments": paths.alignments_file,
        "downlinks": paths.downlinks_file,
    }
    if flags().json:
        tell_json({name: str(path) for name, path in places.items()})
        return
    for name, path in places.items():
        tell(f"{name:12} {path}")
