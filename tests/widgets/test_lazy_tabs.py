from ipywidgets import HTML

from seiswidgets.widgets.app import LazyTabs


def test_a_page_is_made_when_it_is_first_looked_at_and_once():
    made = []

    def page(name):
        made.append(name)
        return HTML(name)

    pages = LazyTabs(Picks=lambda: page("picks"), Weights=lambda: page("weights"))
    assert (pages.titles, made) == (("Picks", "Weights"), ["picks"])
    for number in (1, 0, 1):
        pages.selected_index = number
        assert pages.children[number].children[0].value == ("picks", "weights")[number]
    assert made == ["picks", "weights"]
    pages.selected_index = None  # as a page may send it
    assert made == ["picks", "weights"]
