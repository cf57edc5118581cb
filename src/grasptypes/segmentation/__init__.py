"""Parts and their roles found in the shape of a mesh that names none."""

from pathlib import Path

# The network that comes with the package; `snakemake data/segmentation/network.npz` computes it.
NETWORK = Path(__file__).with_name("network.npz")
