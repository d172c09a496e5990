"""Sphinx configuration: pages from docs/, notebooks/ and the docstrings, built by `make docs`."""

import inspect
import os
from pathlib import Path

from matplotlib.figure import Figure
from traitlets import HasTraits

import seiswidgets

project = "seiswidgets"
author = "the seiswidgets developers"
release = seiswidgets.__version__
extensions = ["myst_nb", "numpydoc", "sphinx.ext.autodoc"]

# The source directory is the project's root, so that the notebooks and CONTRIBUTING.md become pages without copies.
root_doc = "docs/index"
include_patterns = ["docs/**", "notebooks/*.ipynb", "teaching/*.md", "CHANGELOG.md", "CONTRIBUTING.md"]
include_patterns += ["LICENSES.md"]
exclude_patterns = [".venv", "docs/_build", "notebooks/dashboard.ipynb"]

default_role = "literal"
myst_heading_anchors = 3
nb_execution_mode = "cache"  # a notebook runs again only when its code has changed
nb_execution_cache_path = str(Path(__file__).parent / "_build" / "cache")
nb_execution_excludepatterns = ["lab.ipynb"]  # which saves a student's work
nb_execution_excludepatterns += (
    [] if "SEISWIDGETS_DATA_DIR" in os.environ else ["06_real_sections.ipynb", "09_through_time.ipynb"]
)
nb_execution_timeout = 120
# Without a kernel, pages show the app as an image and an exercise as its question, so that they need no widgets.
nb_mime_priority_overrides = [("html", "image/png", 0), ("html", "text/html", 1)]
nb_ipywidgets_js = {}
numpydoc_show_class_members = False
autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"  # the docstrings give types, shapes and units

html_theme = "furo"
html_title = "seiswidgets"
html_static_path = ["static"]
html_css_files = ["guide.css"]
html_copy_source = False
html_show_copyright = False  # it is in LICENSE


def setup(app):
    """Show the parameters of widgets, whose signatures traitlets hides, and make the pages accessible."""
    app.connect("autodoc-process-signature", widget_signature)
    app.connect("html-page-context", make_accessible, priority=900)  # after the theme
    app.connect("builder-inited", write_handouts)


def widget_signature(app, what, name, documented, options, signature, return_annotation):
    """Return the signature of a widget's own __init__, without types."""
    if what != "class" or not issubclass(documented, HasTraits):
        return None
    full = inspect.signature(documented.__init__)
    parameters = [parameter.replace(annotation=parameter.empty) for parameter in list(full.parameters.values())[1:]]
    return str(full.replace(parameters=parameters)), return_annotation


def write_handouts(app):
    """Write the pages and the picture that the gallery shows."""
    folder = Path(app.outdir) / "handouts"
    folder.mkdir(parents=True, exist_ok=True)
    for name, restore in HANDOUTS.items():
        case = getattr(seiswidgets.synthetic, name)()
        restored = restore(case, case.interpretation)
        seiswidgets.save_html(restored, folder / f"{name}.html", case.interpretation)
        if hasattr(case, "stratigraphy"):
            layers = {"stratigraphy": case.stratigraphy, "oldest_first": True}
            story = seiswidgets.plot.storyboard(restored, case.interpretation, figure=Figure(), **layers)
            story.savefig(folder / f"{name}.png", dpi=150)


def unfaulted(case, picks):
    """Unfault along all faults at once."""
    return seiswidgets.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed)


HANDOUTS = {  # synthetic sections, and how each is restored
    "faulted_fold": lambda case, picks: unfaulted(case, picks).flatten(picks.horizon("H2")),
    "domino": unfaulted,
    "thrust": unfaulted,
    "half_graben": lambda case, picks: seiswidgets.Plan.sequential(case.stratigraphy, picks).restore(
        case.section, picks
    ),
}


ACCESSIBLE = {
    'role="heading"': 'role="heading" aria-level="2"',
    "<pre>": '<pre tabindex="0">',  # wide code can be scrolled by keyboard
}


def make_accessible(app, page, template, context, doctree):
    """Add to a page the HTML attributes that Sphinx omits."""
    for part in {"body", "furo_navigation_tree"} & set(context):
        for plain, accessible in ACCESSIBLE.items():
            context[part] = context[part].replace(plain, accessible)
