"""The 3D page of grasps."""

# What the page is made of besides its data; named here, so that the workflow imports nothing else.
PAGE_FILES = ("page.html", "page.js", "three.min.js")
