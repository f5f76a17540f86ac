"""How Sphinx builds the documentation: `sphinx-build -W docs docs/_build`."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from gallery_pages import write_gallery
from site_pages import write_site_pages

import preview_walk

HERE = Path(__file__).parent

project = "preview_walk"
author = "the preview_walk authors"
release = version = preview_walk.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
]
exclude_patterns = ["_build", "**.ipynb_checkpoints"]

html_theme = "furo"
html_title = "preview_walk"
html_static_path: list[str] = []
html_show_sphinx = False
# No font, script or picture comes from elsewhere.
html_theme_options = {"navigation_with_keys": True}

myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence", "smartquotes"]
nb_execution_mode = "force"
nb_execution_timeout = 300
nb_execution_raise_on_error = True

autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_default_options = {"members": True}
autodoc_type_aliases = {"Array": "Array", "Foot": "Foot"}
napoleon_google_docstring = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False

# A type that the reference does not describe is no error; a broken link is.
nitpicky = False
suppress_warnings = ["ref.python"]

write_site_pages(HERE / "site")
write_gallery(HERE / "site")
