"""How Sphinx makes the site; `make docs` runs it on what `pages.py` gathered."""

from html import escape
from importlib.metadata import version as version_of
from typing import ClassVar

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from jinja2.sandbox import SandboxedEnvironment
from numpydoc import docscrape_sphinx
from sphinx.util.logging import getLogger

log = getLogger(__name__)

project = "branchcrush"
author = "The branchcrush developers"
version = release = version_of("branchcrush")

extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}

# Single backticks are code, in docstrings as in Markdown.
default_role = "code"
add_module_names = False
# Each module lists its names itself; in the tables of contents they take a quarter of the time.
toc_object_entries = False

# Of the rooms' own, not what each model of pydantic has.
autodoc_default_options = {"exclude-members": "model_config"}
autodoc_member_order = "bysource"
# Types stand in the docstrings, with shapes and units.
autodoc_typehints = "none"
numpydoc_show_class_members = False

myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3

html_theme = "furo"
html_title = f"branchcrush {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_show_sphinx = False
html_math_renderer = "mathml"


class CompiledOnce(SandboxedEnvironment):
    """Templates that are compiled once for all docstrings: numpydoc compiles anew for each.

    That took a quarter of the time of the site.
    """

    compiled: ClassVar = {}

    def get_template(self, name):
        if name not in self.compiled:
            self.compiled[name] = super().get_template(name)
        return self.compiled[name]


docscrape_sphinx.SandboxedEnvironment = CompiledOnce


def mathml(node, as_block):
    """Return an equation as MathML, which browsers show without any script."""
    try:
        return tex2mathml(node.astext(), as_block=as_block)
    except MathError as error:
        log.warning("no MathML: %s", error, location=node)
        return f"<code>{escape(node.astext())}</code>"


def visit_inline(translator, node):
    translator.body.append(mathml(node, as_block=False))
    raise nodes.SkipNode


def visit_block(translator, node):
    translator.body.append(f'<div class="equation">{mathml(node, as_block=True)}</div>')
    raise nodes.SkipNode


def warn_of_examples_in_text(app, doctree):
    """Warn of examples without a blank line above them, which become part of a paragraph."""
    for paragraph in doctree.findall(nodes.paragraph):
        if ">>> " in paragraph.astext():
            log.warning("an example needs a blank line above it", location=paragraph)


def setup(app):
    app.connect("doctree-read", warn_of_examples_in_text)
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
