"""Links for an editable installation: the folders of the checkout under their one import name."""

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class LinkedParts(BuildHookInterface):
    """Make `build/links/oilfilm`, in which each part of the program is a link to its folder."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Write the links; an ordinary wheel holds copies and needs none."""
        if version != "editable":
            return
        root = Path(self.root)
        links = root / "build" / "links" / "oilfilm"
        links.mkdir(parents=True, exist_ok=True)
        wanted = {path.name: path for path in (root / "oilfilm").iterdir() if path.is_file()}
        wanted |= {part: root / part for part in self.build_config.target_config["sources"]}
        for old in links.iterdir():
            old.unlink()
        for name, path in wanted.items():
            (links / name).symlink_to(path, target_is_directory=path.is_dir())
