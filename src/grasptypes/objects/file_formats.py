"""Which files are meshes, and which are points, by their suffixes."""

MESHES = (".stl", ".obj", ".ply", ".glb")
POINTS = (".ply", ".npy", ".pcd")
