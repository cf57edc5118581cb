"""Hands as data: a URDF and one description each, and what the searches need of them."""
