"""The explorer in a notebook: messages through the kernel, a process that ends with its cell."""

import gc
import json
import sys
import tomllib

import numpy as np
import pytest

import mjcont as mc
from mjcont.explorer.worker import OWNER

pytest.importorskip("anywidget")

from mjcont.explorer import widget as module
from mjcont.explorer.widget import Explorer


class Echo:
    """Stands for the process of a session: answers with what it was asked."""

    made: list["Echo"] = []

    def __init__(self, source, hear):
        self.source, self.hear, self.alive = source, hear, True
        self.made.append(self)

    def send(self, client, text):
        self.hear(client, text)

    def end(self):
        self.alive = False


@pytest.fixture
def echoing(monkeypatch):
    """The stand-ins that were made."""
    monkeypatch.setattr(module, "Worker", Echo)
    monkeypatch.setattr(Echo, "made", [])
    return Echo.made


def listen(explorer):
    """What the widget sends to its page."""
    sent = []
    explorer.send = lambda content, buffers=None: sent.append(content["text"])
    return sent


def ask(explorer, content):
    explorer._handle_custom_msg(content, [])


def test_messages_go_to_the_session_and_back(echoing):
    explorer = Explorer("overcentre")
    sent = listen(explorer)
    ask(explorer, {"text": "a request"})
    assert sent == ["a request"]


@pytest.mark.parametrize("content", [{}, {"text": 3}, "text", None, {"text": "x" * (2**20 + 1)}])
def test_what_is_no_request_goes_nowhere(echoing, content):
    explorer = Explorer("overcentre")
    sent = listen(explorer)
    ask(explorer, content)
    assert sent == []


def test_the_study_can_be_read_in_the_notebook(echoing):
    explorer = Explorer("overcentre")
    echoing[0].hear(OWNER, "model = 'overcentre'")
    assert tomllib.loads(explorer.study) == {"model": "overcentre"}


@pytest.mark.slow
def test_a_widget_that_is_closed_or_forgotten_ends_its_session(echoing):
    first, second = Explorer("overcentre"), Explorer("overcentre")
    first.close()
    assert not echoing[0].alive
    second.close_all()
    del second
    gc.collect()
    assert not echoing[1].alive


def test_a_branch_is_handed_over_as_a_file_that_goes_with_the_widget(echoing, overcentre_branch):
    branch = overcentre_branch(k_j=1000.0)
    explorer = mc.explore(branch)
    np.testing.assert_array_equal(mc.load(echoing[0].source)["F"], branch["F"])
    explorer.close()
    with pytest.raises(mc.ResultFileError, match="no such file"):
        mc.load(echoing[0].source)


def test_a_file_that_is_given_stays_for_the_study_to_name(echoing, overcentre, tmp_path):
    mc.explore(overcentre, tmp_path / "gear.xml").close()
    assert echoing[0].source == str(tmp_path / "gear.xml")
    assert mc.Mechanism.from_xml(tmp_path / "gear.xml").parameters.keys() == overcentre.parameters.keys()


def test_what_has_no_model_text_is_refused():
    field = mc.VectorField(lambda u, p: p["a"] - u * u, [1.0], {"a": 1.0})
    with pytest.raises(mc.MjcontError, match="mc.to_html"):
        mc.explore(mc.continue_equilibria(field, "a", (-1, 2)))


def test_parameters_of_a_program_cannot_travel_with_a_model(overcentre):
    overcentre.declare("width", "geom:link_1.size[0]")
    with pytest.raises(mc.MjcontError, match="parameters of this program's own, width"):
        mc.explore(overcentre)


def test_without_the_extra_the_message_names_it(monkeypatch, overcentre):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "mjcont.explorer.widget")
    with pytest.raises(mc.MjcontError, match=r'pip install "mjcont\[notebook\]"'):
        mc.explore(overcentre)


HOST = """<!DOCTYPE html><div id="cell"></div><script type="module">
import widget from "./explorer.js";
window.asked = [];
const model = { send: (c) => asked.push(c.text), on: (e, f) => (window.hear = f), off: () => (window.hear = null) };
window.leave = await widget.render({ model, el: document.getElementById("cell") });
</script>"""


@pytest.mark.browser
def test_in_a_cell_the_page_is_drawn_and_what_is_clicked_is_computed(chromium, overcentre_branch):
    explorer = mc.explore(overcentre_branch(k_j=1000.0))
    sent = listen(explorer)
    page = chromium.new_page()
    page.route("http://notebook.test/", lambda r: r.fulfill(body=HOST, content_type="text/html"))
    page.route("**/explorer.js", lambda r: r.fulfill(body=explorer._esm, content_type="text/javascript"))
    page.goto("http://notebook.test/")

    def carry(until):
        for _ in range(600):
            for text in page.evaluate("() => asked.splice(0)"):
                ask(explorer, {"text": text})
            while sent:
                page.evaluate("(text) => hear({ text })", sent.pop(0))
            if page.evaluate(until):
                return
            page.wait_for_timeout(50)
        pytest.fail("it did not come to be so")

    carry("() => Boolean(document.querySelector('.mjx.embedded [data-panel=diagram] .line'))")
    page.evaluate("""() => {
        const { store, live } = document.querySelector(".mjx").explorer;
        live.add("sensitivities", { point: "equilibria:LP1" });
    }""")
    carry("() => document.querySelector('.mjx').explorer.store.curves.length === 2")
    assert json.dumps("equilibria:LP1") in explorer.study
    page.evaluate("() => leave()")
    assert page.evaluate("() => hear") is None
    page.close()
    explorer.close()
