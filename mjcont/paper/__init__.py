"""The paper's figures, findings and report."""





