"""The settings of the unit tests: typed, and as the mapping that they are made from."""

from pathlib import Path

from grasptypes.settings.params import Params
from grasptypes.yaml_files import read_yaml

RAW = read_yaml(Path(__file__).with_name("params.yaml"))
PARAMS = Params.check(RAW, "tests/unit/params.yaml")
