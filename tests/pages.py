"""What a page says, without its pictures, scripts and data, and where it leads."""

import html
import re
from pathlib import Path


def said(page: str) -> str:
    """Return a page without what nobody reads."""
    page = re.sub(r"<(script|style)\b.*?</\1>", "", page, flags=re.DOTALL)
    return re.sub(r"base64,[^\"]+", "", page)


def lost_links(path: Path) -> list[str]:
    """Return the links of a page that lead to no file beside it and to no place on it."""
    page = said(path.read_text(encoding="utf-8"))
    places = set(re.findall(r'\bid="([^"]*)"', page))
    links = {html.unescape(link) for link in re.findall(r'\bhref="([^"]*)"', page)}
    lost = {link for link in links if link.startswith("#") and link[1:] not in places}
    local = {link for link in links if not re.match(r"#|https?:|data:", link)}
    return sorted(lost | {link for link in local if not (path.parent / link).exists()})
