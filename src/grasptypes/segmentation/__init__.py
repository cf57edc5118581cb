"""Parts and their roles found in the shape of a mesh that names none."""
