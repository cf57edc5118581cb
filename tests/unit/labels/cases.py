"""Settings and objects that several tests of the labels share."""

import numpy as np

from grasptypes.settings.grasp_types import ContactSettings, LabellingRule, Thresholds

CONTACTS = ContactSettings(
    surface_spacing_m=0.008, patch_depth_m=0.002, reach_m=0.025, closing_weight=3.0
)
THRESHOLDS = Thresholds(
    palm_gap_m=0.020, small_diameter_m=0.050, sideways_share=0.05, large_span_m=0.080
)
RULE = LabellingRule(contacts=CONTACTS, thresholds=THRESHOLDS, finger_length_m=0.125)


class Ball:
    """Signed distance to a sphere about a point of the object frame."""

    def __init__(self, radius, centre=(0.0, 0.0, 0.0)):
        self.centre, self.radius = np.asarray(centre), radius

    def distance_and_gradient(self, points):
        offset = np.asarray(points) - self.centre
        length = np.linalg.norm(offset, axis=-1)
        return length - self.radius, offset / length[..., None]
