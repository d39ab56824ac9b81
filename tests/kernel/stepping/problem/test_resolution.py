"""The step that resolves contact, and the one that is told."""

from together import together

from ssilang.kernel.stepping.problem.plausibility import Resolution


@together("contact_time", [0.030, 0.0299, 0.0281, 0.02999])
def test_a_step_that_is_told_as_the_limit_is_no_reason_to_warn(contact_time):
    told = float(f"{Resolution(contact_time, 1.0).wanted_dt:.3g}")
    assert Resolution(contact_time, told).resolved
    assert not Resolution(contact_time, 1.02 * told).resolved
