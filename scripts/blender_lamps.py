"""The lamps of scripts/blender_room.py, in watts and Blender's metres, z up."""

import math

EFFICACY = 683  # lm/W, as Blender's exporter has it in its standard mode

POINT = {"watts": 60, "place": (1.2, 0.2, 1.9)}
SPOT = {"watts": 150, "place": (-1.4, 0.9, 2.4), "angle": math.radians(70), "blend": 0.4}
PANEL = {"watts": 20, "place": (-0.6, -0.4, 2.55), "size": (1.2, 0.3)}
