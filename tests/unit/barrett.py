"""The BarrettHand, and figures of it that its description does not spell out."""

from grasptypes.hands.reading import load_hand

BARRETT = load_hand("barrett")
LINK = {name: index for index, name in enumerate(BARRETT.link_names)}
COUPLING = 1 / 3
"""How far a fingertip turns with its finger."""
BASE_M, KNUCKLE_M, PROXIMAL_M, DISTAL_M = 0.025, 0.050, 0.070, 0.055
"""Distance of the knuckles from the middle of the palm, and lengths of the links."""
