"""What is known about a mesh before anything is planned: its parts, their roles, and where people
hold them."""
