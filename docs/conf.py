"""Sphinx configuration. Run by CMake's target `docs`, which sets HONEYGUIDE_DOXYGEN_XML."""

import os

project = "Honeyguide"
author = "the Honeyguide developers"
copyright = "2026, the Honeyguide developers"

extensions = ["myst_parser", "breathe"]
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
suppress_warnings = ["myst.strikethrough"]
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = "Honeyguide"

breathe_projects = {"honeyguide": os.environ.get("HONEYGUIDE_DOXYGEN_XML", "_build/doxygen/xml")}
breathe_default_project = "honeyguide"
breathe_domain_by_extension = {"h": "c"}
