"""Pictures of every stage, and the self-contained 3D page.

``svg`` draws an arrangement by hand for notebooks, ``plots`` draws every stage with matplotlib, ``viewer`` makes one
HTML file that shows a surface, and ``colours`` is the one place that chooses their colours. Nothing heavy is imported
before it is needed.
"""
