"""What a plain field u' = f(u, p) is made of: functions of the user's own, held against the shapes that they must have.

Numbers that stand for many states at once: u is (n, m), a parameter a number or (m,), and f is (n, m).
"""
