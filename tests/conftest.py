"""Settings of all tests."""

from hypothesis import HealthCheck, settings

# a busy machine, or a first compilation, is no failure of what is tested
settings.register_profile("house", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("house")
