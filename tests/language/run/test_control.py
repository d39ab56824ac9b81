"""Section 9: SI, REPE, QUIT, ITER, FIN."""

from together import together

from ssilang.cli.run import run_text


def test_names_that_hold_nothing_are_neither_saved_nor_listed(run):
    script = run(
        "SB = 2 ; SA = STRU 1. ; OPTI SAUV 'a.sauv' ; SAUV ; OUBL SB ; LIST ;"
        "OPTI REST 'a.sauv' ; REST ; x = SB ;"
    )
    assert not any("SA " in line for line in script.lines)
    assert script["x"] == 2


@together(
    "text, x, missing",
    [
        ("REPE B 6 ; x = x + 1 ; FIN ; x = 10 ; FIN ;", 1, ["FIN B"]),
        ("SI VRAI ; x = 5 ; FIN ; x = 6 ;", 5, ["FINSI"]),
        ("SI FAUX ; x = 5 ; SINON ; x = 7 ; FIN ;", 7, ["FINSI"]),
        ("REPE B 3 ; x = x + 1 ; SI (x > 0) ; x = 9 ; FIN ;", 9, ["FINSI", "FIN B"]),
    ],
)
def test_fin_in_a_block_that_is_never_closed_ends_the_run(text, x, missing):
    done = run_text(f"x = 0 ; {text}")
    assert (done.exit_code, done.session.root.find("X")) == (0, x)
    assert [w.code for w in done.session.warnings] == ["unclosed-block"] * len(missing)
    assert [w.data["missing"] for w in done.session.warnings] == missing
