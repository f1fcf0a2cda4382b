"""Influence and choice: sensitivities, maps, worst cases."""





