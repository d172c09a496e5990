"""Messages to canvases, decoded: tests see what would be drawn without a browser."""

import json
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from ipycanvas.canvas import COMMANDS
from PIL import Image

NAMES = {number: name for name, number in COMMANDS.items()}


@dataclass
class CanvasMessage:
    """A message to the canvases: its commands by name, each with its arguments, and its pictures."""

    commands: list
    pictures: list

    @classmethod
    def decode(cls, buffers):
        commands = json.loads(bytes(buffers[0]))
        commands = commands if isinstance(commands[0], list) else [commands]
        return cls([(NAMES[command[0]], *command[1:2]) for command in commands], buffers[1:])

    @property
    def names(self):
        return [command[0] for command in self.commands]

    def image(self, index=0):
        """Red, green, blue and alpha of a picture."""
        return np.asarray(Image.open(BytesIO(self.pictures[index])).convert("RGBA"))
