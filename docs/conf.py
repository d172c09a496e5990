"""How the pages are made from docs/, notebooks/ and the docstrings: `make docs`."""

import inspect
import os
from pathlib import Path

from traitlets import HasTraits

import seiswidgets

project = "seiswidgets"
author = "the seiswidgets developers"
release = seiswidgets.__version__
extensions = ["myst_nb", "numpydoc", "sphinx.ext.autodoc"]

# The sources start at the project's folder, so that notebooks and CONTRIBUTING.md are pages without being copied.
root_doc = "docs/index"
include_patterns = ["docs/**", "notebooks/*.ipynb", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSES.md"]
exclude_patterns = [".venv", "docs/_build", "notebooks/dashboard.ipynb"]

default_role = "literal"
myst_heading_anchors = 3
nb_execution_mode = "cache"  # a notebook runs again when its code has changed
nb_execution_cache_path = str(Path(__file__).parent / "_build" / "cache")
nb_execution_excludepatterns = [] if "SEISWIDGETS_DATA_DIR" in os.environ else ["06_real_sections.ipynb"]
nb_execution_timeout = 120
# Where no kernel runs them, the app is seen as its picture and an exercise as its question: no page needs widgets.
nb_mime_priority_overrides = [("html", "image/png", 0), ("html", "text/html", 1)]
nb_ipywidgets_js = {}
numpydoc_show_class_members = False
autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"  # the docstrings say what is given and in which units

html_theme = "furo"
html_title = "seiswidgets"
html_copy_source = False
html_show_copyright = False  # LICENSE says it


def setup(app):
    """Tell what widgets are made with, which traitlets hides, and make the pages accessible."""
    app.connect("autodoc-process-signature", widget_signature)
    app.connect("html-page-context", make_accessible, priority=900)  # after the theme


def widget_signature(app, what, name, thing, options, signature, returned):
    """The signature of a widget's own __init__."""
    if what != "class" or not issubclass(thing, HasTraits):
        return None
    given = inspect.signature(thing.__init__)
    parameters = [one.replace(annotation=one.empty) for one in list(given.parameters.values())[1:]]
    return str(given.replace(parameters=parameters)), returned


ACCESSIBLE = {
    'role="heading"': 'role="heading" aria-level="2"',
    "<pre>": '<pre tabindex="0">',  # wide code can be scrolled by keyboard
}


def make_accessible(app, page, template, context, doctree):
    """Say in a page's HTML what Sphinx leaves out."""
    for part in {"body", "furo_navigation_tree"} & set(context):
        for plain, accessible in ACCESSIBLE.items():
            context[part] = context[part].replace(plain, accessible)
