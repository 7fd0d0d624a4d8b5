"""A block of a page that a program writes: between <!-- NAME --> and <!-- /NAME -->."""
import re


def put_into(page, name, text):
    """Replaces the block; ends the program where the page has none."""
    block = re.compile(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.S)
    whole = page.read_text()
    if not block.search(whole):
        raise SystemExit(f"{page} has no block between <!-- {name} --> and <!-- /{name} -->")
    page.write_text(block.sub(lambda marks: marks[1] + text + "\n" + marks[2], whole))
