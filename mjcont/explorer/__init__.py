"""The explorer: the mechanism beside its diagram, in a page of one file that needs no server, or live.

What the browser draws is a document (`document`), plain data with a version: the shapes of a model (`scene`), curves
with the pose of every row, and the words beside them. A page (`page`) is that document with the script that draws it.

Live, the state is a study (`session`): a click (`clicks`) appends a table to it. A `desk` answers requests in a process
of its own (`worker`), which a `server` on this machine, or a notebook's `widget`, speaks with.
"""
