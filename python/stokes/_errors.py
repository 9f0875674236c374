"""The exceptions and warnings of the package."""

from __future__ import annotations

import re


class SceneError(ValueError):
    """A scene, or a file that it names, is wrong.

    ``str(error)`` is the line that the command line prints, ``file:line:col: error: /json/pointer: message``. For a scene given as a dict
    the line and column are those of the dict as indented JSON.

    Attributes: ``pointer`` (JSON pointer of what is wrong, "" for the whole scene), ``file``, ``line``, ``column``, ``message``.
    """

    def __init__(self, text: str) -> None:
        super().__init__(text)
        place = re.match(r"(.*?):(\d+):(\d+): error: (?:(/.*?): )?(.*)$", text)
        self.file = place[1] if place else ""
        self.line = int(place[2]) if place else 0
        self.column = int(place[3]) if place else 0
        self.pointer = (place[4] or "") if place else ""
        self.message = place[5] if place else text


class DeviceError(RuntimeError):
    """No such device, or an OpenCL call failed."""


class SceneWarning(UserWarning):
    """The scene was rendered, but something in it is probably not what was meant."""


class InvalidSamplesWarning(RuntimeWarning):
    """Some samples were not finite and were left out of the picture."""
