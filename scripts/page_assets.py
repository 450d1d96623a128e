"""Files that lie beside the page, and where they come from."""

LIBRARY = "/usr/share/javascript/dygraphs"
"""Where Debian's libjs-dygraphs is."""
ASSETS = {
    "style.css": "page/style.css",
    "views.js": "page/views.js",
    "dygraph.min.js": f"{LIBRARY}/dygraph.min.js",
    "dygraph.min.css": f"{LIBRARY}/dygraph.min.css",
    "dygraph-licence.txt": "/usr/share/doc/libjs-dygraphs/copyright",
}
"""Each file by its name in results/page/."""
