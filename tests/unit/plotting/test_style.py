"""How every figure looks: its size, its bytes, and numbers as they are."""

import pandas as pd
import pytest
from matplotlib import image

from branchcrush.plotting import style

pytestmark = pytest.mark.filterwarnings("error")


def test_the_same_data_give_the_same_bytes_at_the_size_asked(tmp_path):
    for name in ("one", "two"):
        with style.figure(tmp_path / "new" / f"{name}.png", 100, (3.0, 2.0)) as ax:
            ax.plot([0, 1], [0, 1])
    one, two = ((tmp_path / "new" / f"{name}.png") for name in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()
    assert image.imread(one).shape[:2] == (200, 300)


def test_no_axis_is_to_be_added_to_a_number_at_its_end(tmp_path):
    with style.figure(tmp_path / "one.png", 50) as ax:
        ax.plot([0.71, 0.71 + 1e-7], [1e6, 1e6 + 1.0])
    assert ax.xaxis.get_offset_text().get_text() == ""
    assert not ax.xaxis.get_major_formatter().get_useOffset()


@pytest.mark.parametrize(
    ("x", "limits"), [([0.3, 0.3 + 1e-9], (0.275, 0.325)), ([0.1, 0.9], (0.06, 0.94))]
)
def test_axes_are_widened_to_a_least_width_and_no_more(x, limits):
    ax = style.axes()
    ax.plot(x, [1.0, 2.0])
    assert style.widen(ax).get_xlim() == pytest.approx(limits)


def test_states_come_in_their_order_and_only_those_there_are():
    table = pd.DataFrame({"where": ["end", "near_jamming", "end"], "x": [1, 2, 3]})
    assert [(where, part["x"].tolist()) for where, part in style.of_states(table)] == [
        ("near_jamming", [2]),
        ("end", [1, 3]),
    ]
    assert [where for where, _ in style.of_states(table[:1])] == ["end"]


def test_panels_are_lettered_in_order_and_one_alone_is_not(tmp_path):
    with style.figure(tmp_path / "four.png", 50, panels=(2, 2)) as panels:
        for ax in panels.flat[:3]:
            ax.plot([0, 1], [0, 1])
        panels[0, 0].twinx()
        image = panels[0, 1].imshow([[0, 1]])
        panels[0, 1].figure.colorbar(image, ax=panels[0, 1])
        panels[1, 1].set_axis_off()
    written = [[text.get_text() for text in ax.texts] for ax in panels.flat]
    assert written == [["(a)"], ["(b)"], ["(c)"], []]
    with style.figure(tmp_path / "one.png", 50) as ax:
        ax.plot([0, 1], [0, 1])
    assert not ax.texts


def test_a_figure_is_png_and_svg_with_the_same_bytes_again_and_pdf_for_who_asks(tmp_path):
    def draw(name):
        with style.figure(tmp_path / name, 50) as ax:
            ax.plot([0, 1], [0, 1], label="line")
            ax.set_xlabel(r"$\phi$")
        return {file.suffix: file.read_bytes() for file in tmp_path.glob(f"{name[:-4]}.*")}

    first, again = draw("a.png"), draw("b.png")
    assert first == again and set(first) == {".png", ".svg"}
    # Letters are outlines: no font is asked for.
    assert b"<text" not in first[".svg"] and b"<dc:date>" not in first[".svg"]
    pdf = draw("c.pdf")
    assert set(pdf) == {".pdf"} and b"/FontFile2" in pdf[".pdf"]
