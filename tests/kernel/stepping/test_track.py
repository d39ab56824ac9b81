"""Rows that loops record against whole fields kept at every step, loop by loop."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from references.soil_block import FRICTION, soil_block
from together import together

from ssilang.kernel.contact.rows import Friction
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.relations import Term, joined, relation_rows
from ssilang.kernel.stepping import choose, run
from ssilang.kernel.stepping.choose import only
from ssilang.kernel.stepping.driven import Additions
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.newmark import Scheme, hht
from ssilang.kernel.stepping.node_histories import ForceHistories, NodeHistories
from ssilang.kernel.stepping.problem.loading import Loading
from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.state import Room
from ssilang.kernel.stepping.track import Taps, Track

SIZE = (16, 8, 4)
FIELDS, JOINTS = ("u", "v", "a"), ("w", "t", "state")
STEPS = 150
CHUNK = 65_536


def bouncing(shear=0.0, moving=False, dashpot=False, scheme=None, feet=3, more=0, idle=False):
    """Masses in a row on joints without tension, shaken; `more` masses hang on the last.

    `moving`: the ground moves too; `idle`: a point without mass has a velocity.
    """
    bench, tops, grounds = Bench(), [], []
    for i in range(feet):
        ground, top = bench.node(float(i), -1.0), bench.node(float(i), 0.0)
        bench.fix(ground, "UX")
        grounds.append(bench.relate([(1.0, "UY", ground)]))
        bench.fix(top, "UX") if not shear else bench.spring(1e5, top, unknown="UX")
        bench.mass(500.0 * (i + 1), top)
        bench.joint("SEG2", [ground, top], "JOI1", KN=2e6, KS=shear, V1X=0.0, V1Y=1.0)
        if tops:
            bench.spring(3e5, tops[-1], top)
        tops.append(top)
    for i in range(more):
        top = bench.node(10.0 + i, 0.0)
        bench.fix(top, "UX")
        bench.mass(300.0, top)
        bench.spring(2e5, tops[-1], top)
        tops.append(top)
    bench.spring(1e4, tops[0])
    velocity = None
    if idle:
        light = bench.node(20.0, 0.0)
        bench.spring(1e4, light)
        velocity = bench.field((light, "UY", 0.3))
    if dashpot:
        bench.dashpot(900.0, tops[0])
    t = 2e-3 * np.arange(STEPS + 1)
    weight = bench.field(*((n, "FY", -4000.0) for n in tops))
    push = bench.field((tops[-1], "FY", 6e3), (tops[0], "FY", -3e3))
    parts = bench.load(weight).parts + bench.load(push, t, np.sin(25.0 * t)).parts
    if moving:
        imposed = NodeField.of(bench.table, np.array([grounds[0]]), {"FLX": np.array([1.0])})
        parts += bench.load(imposed, t, 2e-3 * np.sin(40.0 * t)).parts
    fall = bench.field(*((n, "UY", 2e-3 * (i + 1)) for i, n in enumerate(tops)))
    return bench.problem(
        t, Load(parts), displacement=fall, velocity=velocity, scheme=scheme or Scheme()
    )


def stopped(dashpot=False, **options):
    """Masses over stops, which push by relations."""
    bench, nodes = Bench(), []
    for i in range(4):
        node = bench.node(float(i), 0.0)
        bench.mass(20.0 * (1 + i), node)
        bench.fix(node, "UX")
        bench.relate([(1.0, "UY", node)], sense=1)
        if nodes:
            bench.spring(4e5, nodes[-1], node)
        nodes.append(node)
    if dashpot:
        bench.dashpot(300.0, nodes[0])
    t = 2e-3 * np.arange(STEPS + 1)
    weight = bench.field(*((n, "FY", -1200.0) for n in nodes))
    fall = bench.field(*((n, "UY", 0.002 * (i + 1)) for i, n in enumerate(nodes)))
    return bench.problem(t, bench.load(weight), displacement=fall, **options)


def shaken_from_below(problem):
    """The base moves as a sine by imposed values, beside what is given."""
    x = problem.times
    imposed = np.zeros_like(problem.loading.imposed)
    imposed[:, -1] = 1e-3
    curves = (*problem.loading.curves[:-1], (x, np.sin(12.0 * x)))
    return replace(problem, loading=Loading(problem.loading.forces, imposed, curves))


def large(**given):
    return soil_block(steps=STEPS, size=SIZE, joint=FRICTION, **given)


ON_COORDINATES = "springs", "modes", "relations on modes"
CASES = {
    "modes, another at rest": lambda: bouncing(feet=1, shear=1e5, idle=True),
    "springs, one of them": lambda: bouncing(feet=1, more=2),
    "springs": bouncing,
    "modes": lambda: bouncing(shear=1e5),
    "modes, dashpots": lambda: bouncing(shear=1e5, dashpot=True),
    "dissection, small": lambda: bouncing(shear=1e5, moving=True),
    "dissection": large,
    "dissection, supports that move": lambda: shaken_from_below(large()),
    "condensed": lambda: large(scheme=hht(0.1)),
    "conserving": lambda: replace(large(), scheme=Scheme(conserving=True)),
    "adaptive": lambda: bouncing(shear=1e5, scheme=Scheme(adaptive=True)),
    "full Newton": lambda: bouncing(shear=1e5),
    "relations on modes": stopped,
    "condensed, relations": lambda: stopped(dashpot=True),
}


def kept(problem, full=False, driver=None):
    """All instants whole, and the rows of two tracks in the same run."""
    n, size = len(problem.times), problem.numbering.size
    every, some = np.ones(n, bool), np.arange(n) % 7 == 3
    recorder = Recorder(n)
    tracks = [
        Track(every, np.arange(size)[1::3]),
        Track(some, np.arange(size)[-2:]),
        Track(every, np.arange(size)),
    ]
    history = integrate(problem, [recorder, *tracks], full_newton=full, driver=driver)
    return history, recorder, tracks


def assert_same(recorder, tracks):
    size = len(recorder.of("u")[0])
    for track in tracks:
        times = np.array([s.time for s in recorder.snapshots])
        assert np.array_equal(track.times, times[track.wanted])
        for name in FIELDS:
            whole = recorder.of(name)[track.wanted]
            assert np.abs(whole).max() > 0.0
            assert np.array_equal(track.values(name, track.unknowns), whole[:, track.unknowns])
            last = track.unknowns[-1:]
            assert np.array_equal(track.values(name, last), whole[:, last])
        for name in JOINTS:
            assert np.array_equal(track.joints(name), recorder.of(name)[track.wanted])
        contact = np.concatenate([rows.tap.contact for rows in track.pieces])
        if contact.size:
            assert np.array_equal(contact, recorder.of("contact")[track.wanted])
    forces, scale = recorder.of("reaction"), np.abs(recorder.of("reaction")).max()
    whole = next(track for track in tracks if len(track.unknowns) == size)
    found = np.concatenate([rows.values("reaction") for rows in whole.pieces])
    assert np.abs(found - forces).max() <= 1e-9 * scale  # sums in another order


@together("name", CASES)
def test_rows_are_those_of_whole_fields_to_the_last_bit(name, monkeypatch):
    rule = name.split(",")[0]
    monkeypatch.setattr(choose, "RULES", only(rule))
    history, recorder, tracks = kept(CASES[name](), full=rule == "full Newton")
    assert history.method.code == only(rule)[0].said
    assert_same(recorder, tracks)
    if recorder.of("w").size:
        assert recorder.of("w")[..., -1].max() > 0.0  # it opens
        assert recorder.of("t")[..., -1].min() < 0.0  # and closes


def test_pieces_that_fit_in_memory_hold_the_same(monkeypatch):
    whole = kept(bouncing())[2]
    monkeypatch.setattr(run, "CHUNK_VALUES", 400)
    for old, new in zip(whole, kept(bouncing())[2], strict=True):
        assert len(new.pieces) > len(old.pieces)
        found, exact = (t.values("u", t.unknowns) for t in (new, old))
        assert np.abs(found - exact).max() <= 1e-12 * np.abs(exact).max()


def test_a_track_of_few_unknowns_lets_go_of_the_coordinates(monkeypatch):
    monkeypatch.setattr("ssilang.kernel.stepping.track.MOST_COORDINATES", 0)
    _, recorder, tracks = kept(bouncing())
    few = tracks[1].pieces[-1].tap
    assert few.u.shape[1] == 2
    whole = tracks[0].pieces[-1].tap
    assert not any(np.may_share_memory(x, few_x) for x in whole[2:] for few_x in few[2:])
    assert_same(recorder, tracks)


def test_rows_that_are_kept_settle_out_of_their_piece_of_memory(monkeypatch):
    problem, few = bouncing(shear=1e5), np.arange(2)
    tracks = [Track(np.ones(len(problem.times), bool), few) for _ in range(2)]
    integrate(problem, [tracks[0]])
    monkeypatch.setattr("ssilang.kernel.stepping.track.MOST_COORDINATES", 0)
    integrate(problem, [tracks[1]])
    piece, tap = tracks[0].pieces[-1].tap, tracks[1].pieces[-1].tap
    assert base_of(piece.u) is base_of(piece.state)  # one piece holds all parts
    for part in tap[2:]:
        assert base_of(part).nbytes <= tap.state.nbytes
    for name in (*FIELDS, *JOINTS):
        found, exact = (
            t.joints(name) if name in JOINTS else t.values(name, few)
            for t in (tracks[1], tracks[0])
        )
        assert np.array_equal(found, exact)


def base_of(part):
    """The array whose memory a part takes."""
    while part.base is not None:
        part = part.base
    return part


@together("rows, large", [(1000, False), (400_000, True), (3_000_000, True)])
def test_rooms_pieces_begin_with_a_large_page(rows, large):
    shapes, room, done = {"u": (1,), "v": (1,), "w": (2, 3)}, Room(rows), 0
    pieces, begun = [], []
    while done < rows:
        n = min(CHUNK, rows - done)
        tap = room.tap(np.arange(n), np.zeros(1, int), shapes)
        done += n
        parts = [tap.u, tap.v, tap.w]
        assert [x.shape for x in parts] == [(n, 1), (n, 1), (n, 2, 3)]
        assert all(x.flags.c_contiguous for x in parts)
        assert len(tap.t) == len(tap.a) == 0
        if not pieces or base_of(tap.u) is not base_of(pieces[-1][0]):
            place = tap.u.__array_interface__["data"][0]
            assert (place % 2**21 == 0) or not large
            pieces.append(parts)
            begun.append(done - n)
        assert all(base_of(x) is base_of(tap.u) for x in parts)
    full = (27 << 20) // 64
    assert all(full - CHUNK < held <= full for held in np.diff(begun))


def test_rows_of_a_room_do_not_overlap():
    room, taps = Room(100), []
    shapes = {"u": (2,), "state": (1, 3)}
    for i in range(10):
        tap = room.tap(np.arange(10), np.zeros(2, int), shapes)
        tap.u[:], tap.state[:] = i, 100 + i
        taps.append(tap)
    for i, tap in enumerate(taps):
        assert (tap.u == i).all()
        assert (tap.state == 100 + i).all()


@together(
    "others, room, looked_at",
    [
        ([], True, False),
        ([(True, range(4), slice(None))], True, False),  # another that keeps all of it
        ([(True, range(2), slice(None))], True, False),  # one that keeps less
        ([(False, range(4), slice(0, 0))], True, False),  # largest values that nobody asked for
        ([(False, range(4), slice(None))], True, False),  # one that looks at what another keeps
        ([(False, range(6), slice(None))], False, True),  # one that looks at more
    ],
)
def test_tracks_that_keep_rows_as_they_are_get_room(others, room, looked_at):
    def track(keeps, unknowns, when):
        found = Track(np.zeros(50, bool), np.array(unknowns))
        found.wanted[when] = True
        found.keeps = keeps
        return found

    tracks = [track(*x) for x in ((True, range(4), slice(None)), *others)]
    taps = Taps(tracks, 50)
    assert (taps.room is not None, taps.looked_at) == (room, looked_at)


def test_steps_with_additions_are_recorded(monkeypatch):
    problem = bouncing(shear=1e5)
    node = int(problem.numbering.nodes[-1])
    push = NodeField.of(problem.numbering.table, np.array([node]), {"FY": np.array([500.0])})
    _, recorder, tracks = kept(problem, driver=lambda t, state, p: Additions(force=push))
    assert_same(recorder, tracks)


@pytest.mark.parametrize("moving", [False, True])
def test_rows_of_reduced_models(moving):
    problem = soil_block(steps=STEPS, joint=FRICTION)
    problem = shaken_from_below(problem) if moving else problem
    n = len(problem.times)
    recorder, track = Recorder(n), Track(np.ones(n, bool), np.arange(problem.numbering.size)[5::40])
    history = integrate_reduced(problem, 1e-3, [recorder, track])
    assert history.loop == "reduced"
    assert np.array_equal(track.times, problem.times)
    for name in FIELDS:  # products of few rows sum in another order
        whole = recorder.of(name)[:, track.unknowns]
        gap = track.values(name, track.unknowns) - whole
        assert np.abs(gap).max() <= 1e-12 * np.abs(recorder.of(name)).max(), name
    for name in JOINTS:
        assert np.array_equal(track.joints(name), recorder.of(name))


def assert_largest(extremes, recorder):
    """The extremes are those of all instants, kept whole."""
    p = extremes.problem
    found, numbering = extremes.found(), p.numbering
    reactions = np.array([s.support_forces for s in recorder.snapshots])
    u = recorder.of("u")
    for code, (name, dual) in enumerate(zip(numbering.unknowns, numbering.duals, strict=True)):
        mine = np.flatnonzero(numbering.codes == code)
        for kind, label, values in (("DEPL", name, u), ("REACTIONS", dual, reactions)):
            peak = found[kind, label]
            top = np.abs(values[:, mine]).max()
            scale = np.abs(values).max()
            assert abs(abs(peak.value) - top) <= 1e-9 * scale
            assert top or not peak.step  # what stays at rest is largest at the start
            if top > 1e-6 * scale:
                assert abs(values[peak.step, peak.place] - peak.value) <= 1e-9 * scale
                assert numbering.codes[peak.place] == code
    if not len(recorder.of("w")[0]):
        return
    w, t = recorder.of("w"), recorder.of("t")
    shear = np.linalg.norm(t[..., :-1], axis=-1)
    for kind, values in (
        ("OUVERTURE", np.maximum(w[..., -1], 0.0)),
        ("COMPRESSION", np.minimum(t[..., -1], 0.0)),
        ("CISAILLEMENT", shear),
    ):
        peak, top = found[kind, ""], np.abs(values).max()
        assert abs(peak.value) == pytest.approx(top, rel=1e-12)
        assert values[peak.step, peak.place] == pytest.approx(peak.value, rel=1e-12)


@pytest.mark.parametrize("name", CASES)
def test_extremes_are_the_maximum_over_all_steps(name, monkeypatch):
    rule, n = name.split(",")[0], STEPS + 1
    monkeypatch.setattr(choose, "RULES", only(rule))
    problem = CASES[name]()
    recorder, extremes = Recorder(n), Extremes(problem=problem)
    integrate(problem, [recorder, extremes], full_newton=rule == "full Newton")
    assert_largest(extremes, recorder)
    unasked = Extremes(problem=problem, asked=False)
    assert not unasked.known  # before a loop is taken nobody compares
    integrate(problem, [unasked], full_newton=rule == "full Newton")
    assert unasked.known is (rule not in ON_COORDINATES)
    if unasked.known:
        assert_largest(unasked, recorder)


def test_extremes_of_reactions_that_act_elsewhere_than_their_condition():
    """u1 = u2 / 2 is kept by forces on the second and the third of the masses."""
    bench = Bench()
    nodes = [bench.node(float(i), 0.0) for i in range(3)]
    for i, node in enumerate(nodes):
        bench.fix(node, "UX")
        bench.spring(2e4 * (i + 1), node)
        bench.mass(2.0 + i, node)
    bench.spring(1e4, nodes[1], nodes[2])
    bench.relate([(1.0, "UY", nodes[0]), (-0.5, "UY", nodes[1])])
    rows = bench.relations[-1]
    pull = [Term(-0.4, "UY", np.array([nodes[1]])), Term(0.9, "UY", np.array([nodes[2]]))]
    dual = replace(relation_rows(bench.table, pull, 0), raw_multipliers=rows.raw_multipliers)
    bench.relations[-1] = replace(rows, dual=dual)
    times = 5e-3 * np.arange(121)
    load = bench.load(bench.field((nodes[0], "FY", 100.0)), times.tolist(), np.sin(9 * times))
    problem = bench.problem(times, load)
    recorder, extremes = Recorder(len(times)), Extremes(problem=problem)
    integrate(problem, [recorder, extremes])
    pushed = np.array([s.support_forces for s in recorder.snapshots])
    at = [problem.numbering.index_of(node, "UY") for node in nodes]
    assert np.abs(pushed[:, at]).max(axis=0)[0] < 1e-9 * np.abs(pushed).max()
    assert (np.abs(pushed[:, at[1:]]).max(axis=0) > 1.0).all()
    assert_largest(extremes, recorder)


def test_extremes_of_shear_are_those_of_both_directions():
    """Two joints in space, pushed along and across at different times."""
    bench = Bench(Mode.THREE_DIMENSIONAL)
    tops = []
    for i in range(2):
        ground, top = bench.node(2.0 * i, 0.0, -1.0), bench.node(2.0 * i, 0.0, 0.0)
        bench.fix(ground, "UX", "UY", "UZ")
        bench.mass(200.0, top, ("UX", "UY", "UZ"))
        bench.joint("SEG2", [ground, top], "JOI1", KN=2e6, KS=1e6, V1X=0.0, V1Y=0.0, V1Z=1.0,
                    V2X=1.0, V2Y=0.0, V2Z=0.0)  # fmt: skip
        tops.append(top)
    t = 2e-3 * np.arange(31)
    weight = bench.field(*((n, "FZ", -3e3) for n in tops))
    along = bench.field((tops[0], "FX", 500.0), (tops[1], "FX", 700.0))
    across = bench.field((tops[0], "FY", 600.0), (tops[1], "FY", -300.0))
    parts = bench.load(weight).parts + bench.load(along, t, np.sin(90 * t)).parts
    parts += bench.load(across, t, np.cos(60 * t)).parts
    problem = bench.problem(t, Load(parts))
    recorder, extremes = Recorder(len(t)), Extremes(problem=problem)
    integrate(problem, [recorder, extremes])
    assert_largest(extremes, recorder)
    assert np.abs(recorder.of("t")[..., :2]).max(axis=(0, 1)).min() > 300.0


def test_extremes_over_chunks_and_steps_of_two_lengths(monkeypatch):
    whole = large()
    times = np.concatenate([whole.times[:91], whole.times[90] + 0.6 * whole.times[1:60]])
    problem = replace(whole, times=times)
    monkeypatch.setattr(run, "CHUNK_VALUES", 30_000)
    recorder, extremes = Recorder(len(times)), Extremes(problem=problem, asked=False)
    integrate(problem, [recorder, extremes])
    assert extremes.known
    assert_largest(extremes, recorder)


def test_extremes_of_reduced_models():
    problem = soil_block(steps=STEPS, joint=FRICTION)
    recorder, extremes = Recorder(len(problem.times)), Extremes(problem=problem)
    assert integrate_reduced(problem, 1e-3, [recorder, extremes]).loop == "reduced"
    assert_largest(extremes, recorder)


def frame_with_ties():
    """Masses in a row, two of them tied, one held by a relation with the next, one over a stop."""
    bench = Bench()
    nodes = [bench.node(float(i), 0.0) for i in range(5)]
    for i, node in enumerate(nodes):
        bench.mass(20.0 * (1 + i), node)
        if i:
            bench.spring(4e5, nodes[i - 1], node)
            bench.spring(1e5, nodes[i - 1], node, unknown="UX")
    marks = [bench.relate([(2.0, "UX", nodes[0])])]
    marks.append(bench.relate([(1.0, "UX", nodes[1]), (-1.0, "UX", nodes[2])]))
    marks.append(bench.relate([(1.0, "UY", nodes[3]), (0.5, "UX", nodes[3])]))
    marks.append(bench.relate([(1.0, "UY", nodes[4])], sense=1))
    marks.append(bench.relate([(-3.0, "UY", nodes[0])]))
    t = 2e-3 * np.arange(STEPS + 1)
    weight = bench.field(*((n, "FY", -1200.0) for n in nodes))
    push = bench.field((nodes[1], "FX", 900.0), (nodes[4], "FY", 2500.0))
    load = Load(bench.load(weight).parts + bench.load(push, t, np.sin(30.0 * t)).parts)
    problem = bench.problem(t, load)
    return problem, np.sort(np.array(marks)), nodes


@pytest.mark.parametrize("rule", ["relations on modes", "condensed", "conserving"])
def test_multipliers_of_relations_are_followed(rule, monkeypatch):
    monkeypatch.setattr(choose, "RULES", only(rule))
    problem, marks, nodes = frame_with_ties()
    if rule == "conserving":
        problem = replace(problem, scheme=Scheme(conserving=True))
    n, asked = len(problem.times), np.sort(np.append(marks, nodes[2]))
    recorder = Recorder(n)
    few = NodeHistories(np.ones(n, bool), problem=problem, nodes=asked)
    every = NodeHistories(np.ones(n, bool), problem=problem)
    integrate(problem, [recorder, few, every])
    exact = np.array([s.displacement.components["LX"].at(marks) for s in recorder.snapshots])
    assert (np.abs(exact).max(axis=0) > 0.0).all()
    assert np.isfinite(exact).all()
    scale = np.abs(exact).max()
    for j, mark in enumerate(marks.tolist()):
        for track in (few, every):
            gap = np.abs(track.history("u", "LX", mark) - exact[:, j])
            assert gap.max() <= 1e-9 * scale
    for row in (0, 70, n - 1):
        field = few.node_field(row, "u")
        assert np.abs(field.components["LX"].at(marks) - exact[row]).max() <= 1e-9 * scale
        assert field.components["UX"].nodes.tolist() == [nodes[2]]
    assert few.history("u", "LX", nodes[0]) is None
    assert few.history("u", "UX", nodes[0]) is None


def test_sums_of_named_relations_are_their_forces_with_the_frictions_beside():
    """A block slides on two stops, tied to a third mass: each name has what its rows push by.

    A post is held where a tie pulls it, too.
    """
    bench = Bench()
    a, b, c, d, e = (bench.node(float(i), 0.0) for i in range(5))
    for node, mass in ((a, 20.0), (b, 30.0), (c, 25.0), (d, 1.0), (e, 2.0)):
        bench.mass(mass, node)
        bench.spring(3e4, node, unknown="UX")
    bench.spring(2e5, a, b, "UX")
    stops = [bench.relate([(1.0, "UY", n)], sense=1) for n in (a, b)]
    tie = bench.relate([(1.0, "UX", c), (-2.0, "UX", b), (0.5, "UY", c)])
    seat = bench.relate([(3.0, "UY", c), (-1.0, "UX", c)])
    post = bench.relate([(2.0, "UX", d)])
    bench.relate([(1.0, "UX", d), (-1.5, "UX", e)])
    bench.fix(d, "UY")
    bench.fix(e, "UY")
    rows = [relation_rows(bench.table, [Term(1.0, "UX", np.array([n]))], 0) for n in (b, a)]
    rubbing = Friction(joined(rows), 1, np.array([0.3, 0.5]), np.zeros(2), np.array(stops[::-1]),
                       None, np.zeros(2))  # fmt: skip
    t = 2e-3 * np.arange(81)
    weight = bench.field((a, "FY", -200.0), (b, "FY", -400.0), (c, "FY", -90.0))
    push = bench.field((a, "FX", 300.0), (c, "FX", 500.0), (b, "FY", 500.0), (e, "FX", 70.0))
    load = Load(bench.load(weight).parts + bench.load(push, t, np.sin(60.0 * t)).parts)
    problem = bench.problem(t, load, friction=(rubbing,))
    recorder, wanted = Recorder(len(t)), np.arange(len(t)) % 3 == 1
    named = {"all": np.array([*stops, tie, seat]), "left": np.array([stops[0], seat]),
             "right": np.array([stops[1]]), "tie": np.array([tie]),
             "post": np.array([post])}  # fmt: skip
    track = ForceHistories(wanted, problem=problem, named=named)
    history = integrate(problem, [recorder, track])
    assert history.loop
    D, index = problem.constraints.D.toarray(), problem.numbering.index_of
    at = {m: i for i, m in enumerate(problem.multipliers.tolist())}
    found = track.histories
    np.testing.assert_allclose(track.times, t[wanted])
    slid = 0.0
    for k, now in enumerate(np.array(recorder.snapshots)[wanted]):
        p = now.contact
        rest = now.reaction - problem.contact.pushing.T @ p
        lam = np.linalg.lstsq(D.T, rest)[0]
        whole = {n: np.zeros(problem.numbering.size) for n in named}
        for name, nodes in named.items():
            for m in nodes:
                if m in at:
                    whole[name] += lam[at[m]] * D[at[m]]
            for i, m in enumerate(problem.contact.multipliers):
                if m in nodes:
                    node = {stops[0]: a, stops[1]: b}[m]
                    whole[name][index(node, "UY")] += p[i]
                    place = problem.contact.friction.normal.tolist().index(i)
                    whole[name][index(node, "UX")] += p[len(problem.contact) + place]
                    slid = max(slid, abs(p[len(problem.contact) + place]))
        for (name, dual), values in found.items():
            mine = problem.numbering.codes == problem.numbering.duals.index(dual)
            assert values[k] == pytest.approx(whole[name][mine].sum(), abs=1e-6), (name, dual)
    assert slid > 10.0
    assert set(found) == {(n, f) for n in named for f in ("FX", "FY")} - {("post", "FY")}
    kept = track.content()
    again = ForceHistories(wanted, problem=problem, named=named)
    again.restore(kept)
    for key, values in again.histories.items():
        np.testing.assert_array_equal(values, found[key])
