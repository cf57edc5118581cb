"""A page on 127.0.0.1 that predicts the grasp types of an image."""
