"""The command line: `cli` has the parser, each file beside it the commands on a subject.

`common` is what they share, `progress` tells a terminal how long work goes, `told` how a study does, `facts` is what
`--json` prints.
"""
