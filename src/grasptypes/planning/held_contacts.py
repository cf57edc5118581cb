"""The contacts of a plan's grasps, which searching does not record."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grasptypes.hands.hand import Hand
from grasptypes.labels.contact_table import contact_rows
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from grasptypes.settings.physics import PhysicsSettings

GRASP = "Session"


def held_contacts(
    ranking: pd.DataFrame, hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings
) -> pd.DataFrame:
    """Contacts of the valid grasps at the end of the physics test, see `contact_schema`.

    The test is done again from the touching state, in the engine whose result counts; it comes out
    the same.

    Args:
        ranking: grasps of the object, with columns of `grasps.ATTEMPT_SCHEMA`.
    """
    found = [contact_rows(GRASP, 0, (), (), (), ())]
    valid = ranking[ranking.valid]
    if len(valid):
        with engine(settings.engines[0], hand, geometry, settings) as world:
            for row in valid.itertuples():
                pose = np.vstack([np.reshape(row.touching_pose, (3, 4)), [0, 0, 0, 1]])
                contacts = hold(world, pose, np.array(row.touching_joints)).contacts
                found.append(
                    contact_rows(
                        GRASP,
                        int(row.session),
                        [hand.link_names[each.link] for each in contacts],
                        [each.point_m for each in contacts],
                        [each.normal for each in contacts],
                        [each.force_n for each in contacts],
                    )
                )
    return pd.concat(found, ignore_index=True).round(9)
