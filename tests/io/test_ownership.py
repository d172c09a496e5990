from seiswidgets.io.session import ownership


def test_a_kernel_that_has_ended_owns_nothing(tmp_path, monkeypatch):
    path = tmp_path / "work.json"
    ownership.claim(path)
    monkeypatch.setattr(ownership, "OURS", "other")
    assert "process" in str(ownership.other_owner(path))

    def gone(process, signal):
        raise ProcessLookupError

    monkeypatch.setattr(ownership.os, "kill", gone)
    assert ownership.other_owner(path) is None
    path.with_name(".work.json.owner").write_text("{")
    assert ownership.other_owner(path) is None
