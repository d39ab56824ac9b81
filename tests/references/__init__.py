"""Reference solutions that owe nothing to ssilang: closed forms and event-driven exact motions.

They use numpy and scipy only, so that what they say about the program is independent of it.
"""
